// SPDX-License-Identifier: MIT
// Files that are made to crash, stall or fill the memory of who reads them.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mjcf/mjcf_defaults.h"
#include "renderer/import/model/xml.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

TEST(HostileXml, is_refused_with_a_reason) {
  const std::string bomb = R"(<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
    <robot name="&b;"/>)";
  std::string deep = "<mujoco><worldbody>";
  for (int i = 0; i < 100000; ++i) deep += "<body>";
  expect_messages(
      [](const std::string& text) { return mistakes_of(text); },
      {{bomb, "declares entities"},
       {"<robot", "not valid XML"},
       {"", "not valid XML"},
       {"<house/>", "must be <mujoco>"},
       {std::string(3'000'000, '<'), "elements"},
       {deep, "nested too deeply"},
       {"<robot><link name='a'/><link name='b'/><joint name='1' type='fixed'><parent link='a'/>"
        "<child link='b'/></joint><joint name='2' type='fixed'><parent link='b'/><child link='a'/>"
        "</joint></robot>",
        "form a cycle"}});
}

TEST(HostileXml, a_chain_of_a_hundred_thousand_joints_is_read) {
  constexpr int count = 100000;
  std::string text = "<robot name='chain'><link name='0'/>";
  for (int i = 1; i <= count; ++i) {
    const std::string here = std::to_string(i), before = std::to_string(i - 1);
    text += "<link name='" + here + "'/><joint name='j" + here +
            "' type='revolute'><origin xyz='1 0 0'/><parent link='" + before + "'/><child link='" +
            here + "'/></joint>";
  }
  text += "</robot>";
  EXPECT_EQ(link_poses(model_of(text, "chain.urdf")).back().translation, Vec3<double>(count, 0, 0));
}

/// The lines of a text that a program writes about itself.
double resident_megabytes() {
  std::istringstream status(text_of_file("/proc/self/status"));
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / 1024;
    }
  return 0;
}

TEST(HostileXml, models_that_include_each_other_twice_end_soon_and_stay_small) {
  const TemporaryFolder folder;
  // Each file of 4 MiB shows the other one twice: 2^32 of them, or gigabytes of elements.
  const std::string filler(std::size_t{4} << 20, 'x');
  for (const auto& [name, other] : {std::pair{"a.sdf", "b.sdf"}, {"b.sdf", "a.sdf"}})
    std::ofstream(folder / name)
        << "<sdf version='1.6'><model name='m'><link name='l'/><include><uri>" << other
        << "</uri></include><include><uri>" << other << "</uri></include><!--x--><plugin>" << filler
        << "</plugin></model></sdf>";
  const double before = resident_megabytes();
  Mistakes mistakes("a.sdf");
  EXPECT_FALSE(load_model(folder / "a.sdf", {}, mistakes));
  EXPECT_LT(resident_megabytes() - before, 1500);
  EXPECT_LE(mistakes.messages().size(), 110u);
}

TEST(HostileXml, a_hundred_megabytes_are_refused_before_they_are_read) {
  const TemporaryFolder folder;
  std::ofstream(folder / "large.urdf") << "<robot>";
  std::filesystem::resize_file(folder / "large.urdf", std::size_t{100} << 20);
  EXPECT_TRUE(has(mistakes_of_file(folder / "large.urdf"), "must not hold more than"));
}

TEST(HostileXml, numbers_that_are_none_or_too_large_are_told) {
  const auto link = [](const std::string& inside) {
    return "<robot name='r'><link name='a'><visual>" + inside +
           "<geometry><sphere radius='1'/></geometry></visual></link></robot>";
  };
  for (const char* number : {"nan", "inf", "1e999", "-nan", "0x10", "1,5", "1e", "--1"}) {
    const std::string message =
        mistakes_of(link(std::string("<origin xyz='0 0 ") + number + "'/>"));
    EXPECT_TRUE(has(message, "line 1: <origin>: xyz: must be 3 finite number"));
  }
  // Each number is finite, the place of the shape is not.
  const TemporaryFolder folder;
  std::ofstream(folder / "far.xml")
      << "<mujoco><worldbody><body pos='1e308 0 0'><body pos='1e308 0 0'>"
         "<geom size='1'/></body></body></worldbody></mujoco>";
  EXPECT_THROW(import_scene(folder / "far.xml"), BadInput);
}

/// The root of a text, if it can be read.
std::optional<XmlElement> parsed(const std::string& text, Mistakes& mistakes) {
  XmlFiles files(mistakes);
  return files.parse(text, "m.xml");
}

void expect_told(const std::string& text, const std::string& expected,
                 const std::string& file = "m.xml") {
  EXPECT_TRUE(has(mistakes_of(text, file), expected));
}

TEST(HostileXml, an_element_of_too_many_attributes_is_refused_however_they_are_written) {
  // tinyxml2 compares each with all before it: 40,000 of them took seconds, behind a '>' in a value
  // or a blank after the '=' too.
  for (const std::string value :
       {"='1'", "=\"1\"", "=\">\"", "='<'", "= \"\"", " =\n'>\"'", "=''"}) {
    std::string text = "<mujoco>\n<worldbody><geom";
    for (std::size_t i = 0; i <= most_xml_attributes; ++i) text += " a" + std::to_string(i) + value;
    expect_told(text + "/></worldbody></mujoco>",
                "line 2: an element must have at most 200 attributes (got 201)");
  }
  std::string text = "<mujoco><worldbody><geom";
  for (int i = 0; i < 1'000'000; ++i) text += " a" + std::to_string(i) + "='1'";
  expect_told(text + "/></worldbody></mujoco>", "attributes (got 1000000)");
}

TEST(HostileXml, quotes_that_are_no_attributes_are_not_counted) {
  std::string quotes;
  for (std::size_t i = 0; i <= most_xml_attributes; ++i) quotes += " a='1' b=\"'>\"";
  std::string most;
  for (std::size_t i = 0; i < most_xml_attributes; ++i)
    most += " a" + std::to_string(i) + (i % 2 == 0 ? "='\">' " : "=\"'/>\"");
  Mistakes mistakes("m.xml");
  const auto root =
      parsed("<?xml version='1.0'?><?note <a" + quotes + "?><!-- <a" + quotes +
                 " --><!DOCTYPE mujoco PUBLIC \"it's\" 'x'><mujoco>it's <a" + most + "/> 'x' <b" +
                 most + "><![CDATA[<a" + quotes + "/>]]><!--> <a" + quotes + " --></b> '</mujoco>",
             mistakes);
  ASSERT_TRUE(root) << mistakes.text();
  ASSERT_EQ(root->children.size(), 2u);
  for (const XmlElement& child : root->children)
    EXPECT_EQ(child.attributes.size(), most_xml_attributes);
}

TEST(HostileXml, names_of_more_than_a_thousand_bytes_are_refused) {
  // Each link of a composite has its prefix: 90 kB made 40 GB. So did a model's name in SDF.
  const std::string fits(longest_xml_name, 'n'), longer = fits + "n";
  const auto mjcf = [](const std::string& name) {
    return "<mujoco><default class='" + name + "'/><worldbody><body><composite prefix='" + name +
           "' type='grid' count='2 2' spacing='1'><geom size='.1' name='" + name +
           "'/></composite></body></worldbody></mujoco>";
  };
  const std::string message = mistakes_of(mjcf(longer), "m.xml");
  for (const std::string key : {"class", "prefix", "name"})
    EXPECT_TRUE(has(message, ": " + key + ": must have at most 1000 bytes (got 1001)"));
  model_of(mjcf(fits), "m.xml");
  expect_told("<robot name='r'>\n<link name='" + longer + "'/></robot>",
              "line 2: <link name=\"nnn");
  // Models in models: each name is short enough, all of them are not.
  const std::string half(600, 'm');
  expect_told(
      "<sdf version='1.9'><model name='" + half + "'>\n<model name='" + half +
          "'><link name='l'/></model></model></sdf>",
      "name: with the names of the enclosing models, must have at most 1000 bytes (got 1204)",
      "m.sdf");
  const TemporaryFolder folder;
  std::ofstream(folder / "a.sdf")
      << "<sdf version='1.9'><model name='a'><link name='l'/></model></sdf>";
  std::ofstream(folder / "b.sdf") << "<sdf version='1.9'><world name='w'><include><uri>a.sdf</uri>"
                                  << "<name>" << longer << "</name></include></world></sdf>";
  EXPECT_TRUE(has(mistakes_of_file(folder / "b.sdf"),
                  "<include>: name: must have at most 1000 bytes (got 1001)"));
}

std::string attributes_named(const std::string& letter, int count, const std::string& value = "1") {
  std::string text;
  for (int i = 0; i < count; ++i) text += " " + letter + std::to_string(i) + "='" + value + "'";
  return text;
}

TEST(HostileXml, defaults_hold_as_much_as_robots_need) {
  const auto with = [](const std::string& defaults) {
    return "<mujoco>" + defaults + "<worldbody><geom size='1'/></worldbody></mujoco>";
  };
  // Each geom was compared with each of them: 94 kB took two minutes.
  expect_told(with("<default><geom" + attributes_named("a", 150) + "/>\n<default class='c'><geom" +
                   attributes_named("b", 60) + "/></default></default>"),
              "line 2: <geom>: must have at most 200 attributes of 10000 bytes, including "
              "inherited ones (got 210 of ");
  expect_told(with("<default><geom user='" + std::string(10'000, '1') + "'/></default>"),
              "(got 1 of 10004)");
  // Each class has what those around it have.
  std::string classes = "<default><geom user='" + std::string(9'000, '1') + "'/>";
  for (int i = 0; i < 8'000; ++i) classes += "<default class='" + std::to_string(i) + "'/>";
  expect_told(with(classes + "</default>"), "all classes must hold at most 67108864 bytes");
}

TEST(HostileXml, classes_complete_what_an_element_says) {
  Mistakes mistakes("m.xml");
  XmlFiles files(mistakes);
  const auto root = files.parse(
      "<default><geom size='1 2 3' rgba='1 0 0 1' euler='0 0 1'/><default class='c'>"
      "<geom size='4' name='n'/></default></default>",
      "m.xml");
  ASSERT_TRUE(root);
  MjcfDefaults defaults;
  defaults.read(*root, files, "");
  const auto geom = [&](const std::string& text) {
    Mistakes none("m.xml");
    return defaults.with_defaults(parsed(text, none).value(), "", files);
  };
  const XmlElement main = geom("<geom/>"), of_class = geom("<geom class='c' quat='1 0 0 0'/>");
  EXPECT_EQ(main.attribute_or("size"), "1 2 3");
  EXPECT_EQ(geom("<geom size=' 7 8 '/>").attribute_or("size"), " 7 8  3");
  EXPECT_EQ(geom("<geom size='7 8 9 10'/>").attribute_or("size"), "7 8 9 10");
  EXPECT_EQ(of_class.attribute_or("size"), "4 2 3");
  EXPECT_EQ(of_class.attribute_or("rgba"), "1 0 0 1");
  EXPECT_FALSE(of_class.attribute("euler"));
  EXPECT_EQ(of_class.attributes.size(), 5u);
  EXPECT_TRUE(mistakes.none()) << mistakes.text();
}

TEST(HostileXml, elements_are_nested_five_hundred_deep_at_most_with_files_that_are_included) {
  const TemporaryFolder folder;
  const auto name = [](int i) { return "f" + std::to_string(i) + ".xml"; };
  constexpr int files = 6, bodies = 96;
  for (int i = 0; i < files; ++i) {
    std::string text = i == 0 ? "<mujoco><worldbody>" : "<mujocoinclude>", end;
    for (int k = 0; k < bodies; ++k) {
      text += "<body>";
      end += "</body>";
    }
    if (i + 1 < files) text += "<include file='" + name(i + 1) + "'/>";
    std::ofstream(folder / name(i)) << text << "<geom size='1'/>" << end
                                    << (i == 0 ? "</worldbody></mujoco>" : "</mujocoinclude>");
  }
  Mistakes deep("f0.xml"), less_deep("f1.xml");
  EXPECT_FALSE(load_model(folder / name(0), {}, deep));
  EXPECT_TRUE(has(deep.text(), "f5.xml, line 1: <body>: elements must be nested at most 500 deep"));
  std::ofstream(folder / name(1)) << "<mujocoinclude><include file='f2.xml'/></mujocoinclude>";
  EXPECT_TRUE(load_model(folder / name(0), {}, less_deep)) << less_deep.text();
}

TEST(HostileXml, pins_of_a_composite_are_places) {
  const auto with = [](const std::string& pin) {
    return "<mujoco><worldbody><body><composite type='grid' count='3 2' spacing='1'>\n<pin " + pin +
           "/><geom size='.1'/></composite></body></worldbody></mujoco>";
  };
  // These were cast to int, which is undefined.
  for (const std::string coord : {"1e300", "-1", "0.5", "0 1e6"})
    expect_told(with("coord='" + coord + "'"),
                "line 2: <pin>: coord: must be whole numbers from 0 to 100,000 (got \"" + coord);
  expect_told(with(""), "<pin>: coord: missing");
  const Model model = model_of(with("coord='2 1'"), "m.xml");
  ASSERT_EQ(model.links.size(), 7u);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_EQ(model.links[i].joints.size(), i == 6 ? 0u : 3u);
}

TEST(HostileXml, joints_mimic_through_a_hundred_others_at_most) {
  const auto chain = [](int count) {
    std::string text = "<robot name='r'><link name='0'/>";
    for (int i = 1; i <= count; ++i) {
      const std::string here = std::to_string(i), before = std::to_string(i - 1);
      text += "<link name='" + here + "'/><joint name='j" + here +
              "' type='continuous'><parent link='" + before + "'/><child link='" + here + "'/>" +
              (i > 1 ? "<mimic joint='j" + before + "'/>" : "") + "</joint>";
    }
    return text + "</robot>";
  };
  model_of(chain(101), "r.urdf");
  expect_told(chain(102), "or through more than 100 others", "r.urdf");
}

TEST(HostileXml, a_model_has_a_million_shapes_at_most) {
  // A mesh of a thousand parts is shown by a thousand lines.
  MeshLibrary::Answer answer;
  answer.parts.assign(most_geoms + 1, {{}, sphere_of(1), {}});
  Mistakes mistakes("r.urdf");
  XmlFiles files(mistakes);
  const auto mesh = files.parse("\n<mesh filename='m.obj'/>", "r.urdf");
  ASSERT_TRUE(mesh);
  Model model;
  add_mesh(model, files, *mesh, answer, {}, {});
  EXPECT_TRUE(model.geoms.empty());
  EXPECT_TRUE(has(mistakes.text(),
                  "line 2: <mesh filename=\"m.obj\">: shows 1000001 parts: with the "
                  "shapes before, a model must have at most 1000000 shapes (got "
                  "1000001)"));
  answer.parts.assign(2, {{}, sphere_of(1), {}});
  add_mesh(model, files, *mesh, answer, {}, {});
  EXPECT_EQ(model.geoms.size(), 2u);
}

TEST(HostileXml, a_mesh_is_shown_at_so_many_scales) {
  const TemporaryFolder folder;
  // Each scale has a hull of its own. This one has none: it is too wide for numbers.
  std::ofstream obj(folder / "m.obj");
  constexpr int vertices = 100'000, scales = 11;
  for (int i = 0; i < vertices; ++i) obj << (i % 2 == 0 ? "v 1e308 0 0\n" : "v -1e308 0 0\n");
  obj.close();
  std::string text = "<robot name='r'><link name='a'>\n";
  for (int i = 0; i < scales; ++i)
    text += "<visual><geometry><mesh filename='m.obj' scale='1 1 " + std::to_string(i + 1) +
            "'/></geometry></visual>\n";
  std::ofstream(folder / "r.urdf") << text << "</link></robot>";
  Mistakes mistakes("r.urdf");
  EXPECT_FALSE(load_model(folder / "r.urdf", {}, mistakes));
  ASSERT_EQ(mistakes.messages().size(), 11u);
  EXPECT_TRUE(has(mistakes.messages().back(),
                  "line 12: <mesh filename=\"m.obj\">: the mesh \"m.obj\": with the meshes before, "
                  "each once per scale, hulls must have at most 1000000 vertices (got "
                  "1100000)"))
      << mistakes.text();
}

TEST(HostileXml, bodies_and_classes_that_are_not_there_are_named) {
  expect_told(
      "<mujoco><worldbody><body childclass='none'><geom size='1' class='other'/></body></worldbody>"
      "</mujoco>",
      "no defaults for class \"other\"");
  expect_told(
      "<sdf version='1.6'><model name='m'><link name='a'/><joint name='j' type='fixed'>"
      "<parent>a</parent><child>absent</child></joint></model></sdf>",
      "the link \"absent\" not found", "m.sdf");
  expect_told(
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent "
      "link='a'/><child link='b'/><mimic joint='none'/></joint></robot>",
      "the joint \"none\" not found", "r.urdf");
}

TEST(HostileXml, names_that_are_no_text_are_written_as_scenes_all_the_same) {
  const TemporaryFolder folder;
  std::ofstream(folder / "r.xml") << "<mujoco model='\xff\xfe'><worldbody><body name='\xc0\x80'>"
                                     "<geom name='\x80' size='1'/></body></worldbody></mujoco>";
  for (const std::string command : {"info --json r.xml", "info r.xml", "import r.xml -o r.json -q",
                                    "render r.json -o r.png -r 8x8 -s 1 -q"}) {
    const ProgramOutcome outcome = run_minkray(folder, command);
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
}

TEST(HostileXml, files_that_include_each_other_and_large_files_are_refused) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("a.xml", "<mujoco><include file='b.xml'/></mujoco>");
  write("b.xml", "<mujoco><include file='a.xml'/></mujoco>");
  EXPECT_TRUE(has(mistakes_of_file(folder / "a.xml"), "included twice"));
  write("large.xml", std::string(most_xml_bytes + 1, ' '));
  mistakes_of_file(folder / "large.xml");
}

TEST(HostileXml, a_hundred_thousand_kinds_of_unknown_elements_are_counted_in_seconds) {
  std::string text = "<robot name='r'><link name='a'/>";
  constexpr std::size_t kinds = 100'000;
  for (std::size_t i = 0; i < kinds; ++i) text += "<x" + std::to_string(i) + "/>";
  const auto begin = std::chrono::steady_clock::now();
  const Model model = model_of(text + "</robot>", "r.urdf");
  std::size_t count = 0;
  for (const PassedOver& one : model.passed_over) count += one.count;
  EXPECT_EQ(count, kinds);
  EXPECT_LE(model.passed_over.size(), 201u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace minkray
