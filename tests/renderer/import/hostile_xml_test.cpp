// SPDX-License-Identifier: MIT
// Files that are made to crash, stall or fill the memory of who reads them.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "renderer/import/xml.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

TEST(HostileXml, is_refused_with_a_reason) {
  const std::string bomb = R"(<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
    <robot name="&b;"/>)";
  EXPECT_NE(mistakes_of(bomb).find("declares entities"), std::string::npos);
  EXPECT_NE(mistakes_of("<robot").find("no XML"), std::string::npos);
  EXPECT_NE(mistakes_of("").find("no XML"), std::string::npos);
  EXPECT_NE(mistakes_of("<house/>").find("must be <mujoco>"), std::string::npos);
  std::string many(3'000'000, '<');
  EXPECT_NE(mistakes_of(many).find("elements"), std::string::npos);
  std::string deep = "<mujoco><worldbody>";
  for (int i = 0; i < 100000; ++i) deep += "<body>";
  EXPECT_NE(mistakes_of(deep).find("nested too deeply"), std::string::npos);
  EXPECT_NE(
      mistakes_of("<robot><link name='a'/><link name='b'/><joint name='1' type='fixed'><parent "
                  "link='a'/><child link='b'/></joint><joint name='2' type='fixed'><parent "
                  "link='b'/><child link='a'/></joint></robot>")
          .find("in a circle"),
      std::string::npos);
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
  Mistakes mistakes("chain.urdf");
  const std::optional<Model> model = parse_model(text, "chain.urdf", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  EXPECT_EQ(link_poses(*model).back().translation, Vec3<double>(count, 0, 0));
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
  Mistakes mistakes("large.urdf");
  EXPECT_FALSE(load_model(folder / "large.urdf", {}, mistakes));
  EXPECT_NE(mistakes.text().find("must not hold more than"), std::string::npos);
}

TEST(HostileXml, numbers_that_are_none_or_too_large_are_told) {
  const auto link = [](const std::string& inside) {
    return "<robot name='r'><link name='a'><visual>" + inside +
           "<geometry><sphere radius='1'/></geometry></visual></link></robot>";
  };
  for (const char* number : {"nan", "inf", "1e999", "-nan", "0x10", "1,5", "1e", "--1"}) {
    const std::string told = mistakes_of(link(std::string("<origin xyz='0 0 ") + number + "'/>"));
    EXPECT_NE(told.find("line 1: <origin>: xyz: must be 3 finite number"), std::string::npos)
        << told;
  }
  // Each number is finite, the place of the shape is not.
  const TemporaryFolder folder;
  std::ofstream(folder / "far.xml")
      << "<mujoco><worldbody><body pos='1e308 0 0'><body pos='1e308 0 0'>"
         "<geom size='1'/></body></body></worldbody></mujoco>";
  EXPECT_THROW(import_scene(folder / "far.xml"), BadInput);
}

TEST(HostileXml, an_element_of_a_million_attributes_is_refused_at_once) {
  std::string text = "<mujoco><worldbody><geom";
  for (int i = 0; i < 1'000'000; ++i) text += " a" + std::to_string(i) + "='1'";
  EXPECT_NE(mistakes_of(text + "/></worldbody></mujoco>", "m.xml").find("attributes"),
            std::string::npos);
}

TEST(HostileXml, bodies_and_classes_that_are_not_there_are_named) {
  EXPECT_NE(mistakes_of("<mujoco><worldbody><body childclass='none'><geom size='1' class='other'/>"
                        "</body></worldbody></mujoco>",
                        "m.xml")
                .find("no defaults of the class \"other\""),
            std::string::npos);
  EXPECT_NE(
      mistakes_of("<sdf version='1.6'><model name='m'><link name='a'/><joint name='j' "
                  "type='fixed'><parent>a</parent><child>nobody</child></joint></model></sdf>",
                  "m.sdf")
          .find("the link \"nobody\" is not there"),
      std::string::npos);
  EXPECT_NE(mistakes_of("<robot name='r'><link name='a'/><link name='b'/><joint name='j' "
                        "type='revolute'><parent link='a'/><child link='b'/><mimic joint='none'/>"
                        "</joint></robot>")
                .find("the joint \"none\" is not there"),
            std::string::npos);
}

TEST(HostileXml, names_that_are_no_text_are_written_as_scenes_all_the_same) {
  const TemporaryFolder folder;
  std::ofstream(folder / "r.xml") << "<mujoco model='\xff\xfe'><worldbody><body name='\xc0\x80'>"
                                     "<geom name='\x80' size='1'/></body></worldbody></mujoco>";
  for (const std::string command : {"info --json r.xml", "info r.xml", "import r.xml -o r.json -q",
                                    "render r.json -o r.png -r 8x8 -s 1 -q"}) {
    const ProgramOutcome outcome = run_shell("cd '" + folder / "" + "' && $MINKRAY " + command);
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
  Mistakes circle(folder / "a.xml");
  EXPECT_FALSE(load_model(folder / "a.xml", {}, circle));
  EXPECT_NE(circle.text().find("included twice"), std::string::npos) << circle.text();
  write("large.xml", std::string(most_xml_bytes + 1, ' '));
  Mistakes large(folder / "large.xml");
  EXPECT_FALSE(load_model(folder / "large.xml", {}, large));
}

TEST(HostileXml, a_hundred_thousand_kinds_of_unknown_elements_are_counted_in_seconds) {
  std::string text = "<robot name='r'><link name='a'/>";
  constexpr std::size_t kinds = 100'000;
  for (std::size_t i = 0; i < kinds; ++i) text += "<x" + std::to_string(i) + "/>";
  Mistakes mistakes("r.urdf");
  const auto begin = std::chrono::steady_clock::now();
  const auto model = parse_model(text + "</robot>", "r.urdf", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  std::size_t count = 0;
  for (const PassedOver& one : model->passed_over) count += one.count;
  EXPECT_EQ(count, kinds);
  EXPECT_LE(model->passed_over.size(), 201u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace minkray
