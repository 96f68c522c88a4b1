// SPDX-License-Identifier: MIT
// URDF and SDF: kinematics beside a second way to them, real models, and hostile files.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "renderer/import/import.h"
#include "renderer/import/xml.h"
#include "renderer/scene/scene_json.h"
#include "renderer/scene/write_scene.h"
#include "tests/support/program.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

using Number = long double;
using Quaternion = Eigen::Quaternion<Number>;
using Vector = Eigen::Matrix<Number, 3, 1>;

/// A URDF's joints as regular expressions find them, and the links' frames by quaternions in long
/// double: shares nothing with the reader.
class SecondKinematics {
 public:
  explicit SecondKinematics(const std::string& file) {
    std::string text = text_of_file(file);
    text = std::regex_replace(text, std::regex("<!--[^]*?-->"), "");
    const std::regex joint("<joint\\s([^>]*[^/])>([^]*?)</joint>");
    for (std::sregex_iterator at(text.begin(), text.end(), joint), end; at != end; ++at) {
      const std::string head = " " + at->str(1), body = at->str(2);
      if (attribute(head, "type").empty()) continue;  // of a transmission
      Joint read;
      read.name = attribute(head, "name");
      read.type = attribute(head, "type");
      read.parent = attribute(element(body, "parent"), "link");
      const std::string child = attribute(element(body, "child"), "link");
      const std::string origin = element(body, "origin");
      read.xyz = vector(attribute(origin, "xyz"), Vector(0, 0, 0));
      read.rpy = vector(attribute(origin, "rpy"), Vector(0, 0, 0));
      read.axis = vector(attribute(element(body, "axis"), "xyz"), Vector(1, 0, 0)).normalized();
      if (!child.empty()) joints_[child] = read;
    }
  }

  std::size_t size() const { return joints_.size(); }

  void frame(const std::string& link, const std::map<std::string, double>& values, Vector& at,
             Quaternion& turned) const {
    const auto found = joints_.find(link);
    if (found == joints_.end()) {
      at.setZero();
      turned.setIdentity();
      return;
    }
    const Joint& joint = found->second;
    frame(joint.parent, values, at, turned);
    at += turned * joint.xyz;
    for (const int axis : {2, 1, 0})
      turned = turned * Quaternion(Eigen::AngleAxis<Number>(joint.rpy[axis], Vector::Unit(axis)));
    const auto value = values.find(joint.name);
    if (value == values.end()) return;
    if (joint.type == "prismatic")
      at += turned * Vector(Number(value->second) * joint.axis);
    else
      turned = turned * Quaternion(Eigen::AngleAxis<Number>(Number(value->second), joint.axis));
  }

 private:
  struct Joint {
    std::string name, type, parent;
    Vector xyz, rpy, axis;
  };
  static std::string element(const std::string& body, const std::string& name) {
    std::smatch match;
    return std::regex_search(body, match, std::regex("<" + name + "(\\s[^>]*)>")) ? match.str(1)
                                                                                  : "";
  }
  static std::string attribute(const std::string& text, const std::string& name) {
    std::smatch match;
    return std::regex_search(text, match, std::regex("\\s" + name + "\\s*=\\s*[\"']([^\"']*)"))
               ? match.str(1)
               : "";
  }
  static Vector vector(const std::string& text, const Vector& otherwise) {
    std::istringstream stream(text);
    double x = 0, y = 0, z = 0;
    return stream >> x >> y >> z ? Vector(x, y, z) : otherwise;
  }
  std::map<std::string, Joint> joints_;
};

ImportOptions without_meshes() {
  ImportOptions options;
  options.skip_missing_meshes = true;
  return options;
}

TEST(Urdf, links_stand_where_a_second_way_in_long_double_puts_them) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  const std::string atlas = "simbody/TaskSpaceControl-Atlas/models/atlas_v4.urdf";
  for (const std::string& name : {atlas, std::string("dart/urdf/wam/wam.urdf"),
                                  std::string("dart/urdf/KR5/KR5 sixx R650.urdf"),
                                  std::string("dart/urdf/drchubo/drchubo.urdf")}) {
    const std::string file = (robot_models() / name).string();
    Mistakes mistakes(file);
    std::optional<Model> model = load_model(file, without_meshes(), mistakes);
    ASSERT_TRUE(model) << mistakes.text();
    const SecondKinematics second(file);
    ASSERT_GT(second.size(), 5u) << name;
    testing::Random random(5);
    double worst = 0;
    for (int state = 0; state < 100; ++state) {
      std::map<std::string, double> values;
      for (ModelLink& link : model->links)
        for (ModelJoint& joint : link.joints)
          if (width_of(joint.kind) == 1) {
            values[joint.name] = random.uniform(-3, 3);
            joint.value = {values[joint.name]};
          }
      const std::vector<Affine<double>> poses = link_poses(*model);
      for (std::size_t i = 0; i < poses.size(); ++i) {
        Vector at;
        Quaternion turned;
        second.frame(model->links[i].name, values, at, turned);
        const Mat3<double> rotation = turned.toRotationMatrix().cast<double>();
        worst = std::max({worst, (poses[i].translation - at.cast<double>()).norm(),
                          (poses[i].linear - rotation).cwiseAbs().maxCoeff()});
      }
    }
    EXPECT_LT(worst, 1e-12) << name;
  }
}

TEST(Robots, every_description_of_the_packages_is_read_or_refused_with_a_reason) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  std::vector<std::string> files;
  for (const char* folder : {"dart", "simbody"})
    for (const char* ending : {".urdf", ".sdf", ".world"})
      for (const std::string& file : robot_files(folder, ending)) files.push_back(file);
  int read = 0;
  for (const std::string& file : files) {
    Mistakes mistakes(file);
    const std::optional<Model> model = load_model(file, without_meshes(), mistakes);
    EXPECT_EQ(model.has_value(), mistakes.none()) << file;
    read += model ? 1 : 0;
    if (model) {
      EXPECT_GT(model->links.size() + model->geoms.size() + model->passed_over.size(), 0u) << file;
    }
  }
  EXPECT_GE(files.size(), 35u);
  EXPECT_GE(read, 25);  // most of them, so that the test says something
}

TEST(Robots, a_scene_file_written_from_a_robot_is_the_same_scene) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  for (const char* name : {"mujoco/humanoid/humanoid.xml", "dart/urdf/drchubo/drchubo.urdf"}) {
    ImportOptions options = without_meshes();
    options.joints = {std::string(name).find("drchubo") != std::string::npos ? "LEP=-0.5"
                                                                             : "abdomen_z=0.3"};
    const Scene scene = import_scene(robot_models() / name, options).scene;
    Mistakes mistakes("written.json");
    const auto again = parse_scene(scene_text(scene), ".", mistakes);
    ASSERT_TRUE(again) << mistakes.text();
    ASSERT_EQ(again->objects.size(), scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object &a = scene.objects[i], &b = again->objects[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.pose, b.pose);
      EXPECT_EQ(a.shape.kind.index(), b.shape.kind.index());
      EXPECT_EQ(a.half_space.has_value(), b.half_space.has_value());
      for (const Vec3<double>& n : {Vec3<double>(1, 2, 3), Vec3<double>(-3, 1, -2)})
        EXPECT_EQ(a.shape.support(n), b.shape.support(n));
    }
  }
}

std::string told_of(const std::string& text, const std::string& file = "robot.urdf") {
  Mistakes mistakes(file);
  EXPECT_FALSE(parse_model(text, file, {}, mistakes));
  return mistakes.text();
}

TEST(Urdf, mimics_follow_and_capsules_are_read) {
  const std::string text = R"(<robot name="two"><link name="a"/>
    <link name="b"><visual><geometry><capsule radius="0.1" length="0.4"/></geometry></visual></link>
    <link name="c"/>
    <joint name="ab" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
    <joint name="ac" type="prismatic"><parent link="a"/><child link="c"/><axis xyz="1 0 0"/>
      <mimic joint="ab" multiplier="2" offset="0.5"/></joint></robot>)";
  Mistakes mistakes("robot.urdf");
  std::optional<Model> model = parse_model(text, "robot.urdf", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  find_joint(*model, "ab")->value = {1};
  follow_mimics(*model);
  EXPECT_EQ(link_poses(*model)[2].translation, Vec3<double>(2.5, 0, 0));
  ASSERT_EQ(model->geoms.size(), 1u);
  EXPECT_NEAR(model->geoms[0].shape->support(Vec3<double>(0, 0, 1)).z(), 0.3, 1e-15);
}

TEST(Urdf, mistakes_are_told_all_at_once_with_their_lines) {
  const std::string told = told_of(R"(<robot name="bad">
<link name="a"><visual><geometry><box size="1 -1 1"/></geometry></visual></link>
<link name="a"/>
<link name="b"><collision><geometry><wedge/></geometry></collision>
  <visual><geometry><mesh filename="package://none/x.stl"/></geometry></visual></link>
<joint name="j" type="revolving"><parent link="a"/><child link="nobody"/></joint>
</robot>)");
  for (const char* expected :
       {"line 2: <box>: size", "line 3: <link name=\"a\">: name: must not be the name of two",
        "line 4: <wedge>: must be one of box", "looked for", "line 6: <joint name=\"j\">: type",
        "the link \"nobody\" is not there"})
    EXPECT_NE(told.find(expected), told.npos) << expected << " in\n" << told;
}

TEST(Sdf, poses_are_relative_to_frames_links_and_joints) {
  const std::string text = R"(<sdf version="1.9"><model name="m"><pose>1 0 0 0 0 0</pose>
    <frame name="f" attached_to="base"><pose>0 0 1 0 0 0</pose></frame>
    <link name="base"><pose>0 2 0 0 0 0</pose></link>
    <link name="tip"><pose relative_to="f">0 0 0.5 0 0 1.5707963267948966</pose>
      <visual name="v"><geometry><plane><normal>0 1 0</normal></plane></geometry></visual></link>
    <joint name="j" type="revolute"><parent>base</parent><child>tip</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
    <model name="inner"><pose relative_to="tip">1 0 0 0 0 0</pose><link name="x"/></model>
    </model></sdf>)";
  Mistakes mistakes("m.sdf");
  std::optional<Model> model = parse_model(text, "m.sdf", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  std::map<std::string, Vec3<double>> at;
  const auto poses = link_poses(*model);
  for (std::size_t i = 0; i < poses.size(); ++i) at[model->links[i].name] = poses[i].translation;
  EXPECT_LT((at["m::base"] - Vec3<double>(1, 2, 0)).norm(), 1e-15);
  EXPECT_LT((at["m::tip"] - Vec3<double>(1, 2, 1.5)).norm(), 1e-15);
  EXPECT_LT((at["m::inner::x"] - Vec3<double>(1, 3, 1.5)).norm(), 1e-15);
}

TEST(HostileXml, is_refused_with_a_reason) {
  const std::string bomb = R"(<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
    <robot name="&b;"/>)";
  EXPECT_NE(told_of(bomb).find("declares entities"), std::string::npos);
  EXPECT_NE(told_of("<robot").find("no XML"), std::string::npos);
  EXPECT_NE(told_of("").find("no XML"), std::string::npos);
  EXPECT_NE(told_of("<house/>").find("must be <mujoco>"), std::string::npos);
  std::string many(3'000'000, '<');
  EXPECT_NE(told_of(many).find("elements"), std::string::npos);
  std::string deep = "<mujoco><worldbody>";
  for (int i = 0; i < 100000; ++i) deep += "<body>";
  EXPECT_NE(told_of(deep).find("nested too deeply"), std::string::npos);
  EXPECT_NE(told_of("<robot><link name='a'/><link name='b'/><joint name='1' type='fixed'><parent "
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

TEST(Meshes, parts_have_hulls_of_their_own) {
  const TemporaryFolder folder;
  std::string obj;
  for (const int x : {0, 10})
    for (int i = 0; i < 4; ++i)
      obj += "v " + std::to_string(x + (i == 1)) + " " + std::to_string(i == 2) + " " +
             std::to_string(i == 3) + "\n";
  obj +=
      "g left\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\ng right\nf 5 6 7\nf 5 6 8\nf 5 7 8\nf 6 7 8\n";
  std::ofstream(folder / "two.obj") << obj;
  std::ofstream(folder / "r.urdf") << "<robot name='r'><link name='a'><visual><geometry><mesh "
                                      "filename='two.obj' scale='-1 1 1'/></geometry></visual>"
                                      "</link></robot>";
  for (const MeshSplit split : {MeshSplit::none, MeshSplit::groups, MeshSplit::components}) {
    ImportOptions options;
    options.split = split;
    const Imported imported = import_scene(folder / "r.urdf", options);
    ASSERT_EQ(imported.scene.objects.size(), split == MeshSplit::none ? 1u : 2u);
    // Mirrored: what lay at x = 10 lies at x = -10.
    const Object& last = imported.scene.objects.back();
    EXPECT_EQ(last.shape.support(Vec3<double>(-1, 0, 0)).x(), -11);
  }
}

}  // namespace
}  // namespace minkray
