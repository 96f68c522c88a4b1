// SPDX-License-Identifier: MIT
// Options for robots: keyframes and joints by name, and the messages where they are impossible, or
// are applied otherwise than a robot could.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "renderer/base/errors.h"
#include "renderer/import/model_info.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

class RobotOptions : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  /// Position of the last shape of the scene.
  static Vec3<double> last_place(const Imported& imported) {
    return imported.scene.objects.back().pose.translation;
  }

  TemporaryFolder folder_;
};

TEST_F(RobotOptions, keyframes_are_known_by_their_names_and_numbers) {
  const std::string file = write("r.xml", R"(<mujoco><worldbody><body><joint type="slide"/>
    <geom size=".1"/></body></worldbody><keyframe><key name="up" qpos="0.5"/><key qpos="0.25"/>
    <key name="rest"/><key name="0" qpos="4"/></keyframe></mujoco>)");
  ImportOptions options;
  // A name is looked for before a number.
  for (const auto& [name, height] : {std::pair<const char*, double>{"up", 0.5},
                                     {"1", 0.25},
                                     {"rest", 0.0},
                                     {"2", 0.0},
                                     {"0", 4.0},
                                     {"3", 4.0}}) {
    options.keyframe = name;
    EXPECT_EQ(last_place(import_scene(file, options)).z(), height) << name;
  }
  options.keyframe = "down";
  EXPECT_TRUE(has(complaint(file, options), "its keyframes are up, 1, rest, 0"));
}

constexpr const char* gripper = R"(<robot name="g"><link name="a"/>
  <link name="b"><visual><geometry><sphere radius="1"/></geometry></visual></link>
  <link name="c"><visual><geometry><sphere radius="1"/></geometry></visual></link>
  <joint name="left" type="prismatic"><parent link="a"/><child link="b"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="right" type="prismatic"><parent link="a"/><child link="c"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="left" multiplier="2"/></joint>
  </robot>)";

TEST_F(RobotOptions, a_joint_that_follows_another_takes_no_value_of_its_own) {
  const std::string file = write("r.urdf", gripper);
  ImportOptions options;
  options.joints = {"right=1"};
  EXPECT_TRUE(has(complaint(file, options), "--joint: right follows left"));
  // Recorded rows hold all joints; values for such a one are reported as ignored.
  options.joints = {};
  options.joint_rows = write("rows.csv", "time,left,right\n0,0.25,7\n");
  const Imported imported = import_scene(file, options);
  EXPECT_EQ(imported.scene.objects.back().motion->pose_at(0).translation.x(), 0.5);
  EXPECT_TRUE(has(model_as_text(*imported.model), "values of the joint \"right\""));
}

TEST_F(RobotOptions, joints_beyond_their_limits_stand_there_and_are_told) {
  const std::string file = write("r.urdf", gripper);
  ImportOptions options;
  options.joints = {"left=0.75"};
  const Imported imported = import_scene(file, options);
  EXPECT_EQ(last_place(imported).x(), 1.5);
  const std::string text = model_as_text(*imported.model);
  EXPECT_TRUE(has(text, "limit of the joint \"right\": at 1.5, outside 0 to 1"));
  EXPECT_FALSE(has(text, "limit of the joint \"left\""));
}

TEST_F(RobotOptions, every_wrong_joint_is_told_at_once) {
  const std::string file = write("r.urdf", gripper);
  ImportOptions options;
  options.joints = {"lefd=1", "left", "left=nan", "left=1,2", "left=0.5"};
  options.keyframe = "home";
  const std::string text = complaint(file, options);
  expect_parts(text, {"got \"lefd=1\"; joints are left, right", "got \"left\"",
                      "left takes one finite number", "(got \"nan\")", "(got \"1,2\")",
                      "--keyframe: no keyframe named home"});
}

TEST_F(RobotOptions, each_place_where_a_mesh_was_looked_for_is_named_once) {
  const std::string file = write("r.urdf", R"(<robot name="r"><link name="a"><visual><geometry>
    <mesh filename="package://arm/meshes/a.stl"/></geometry></visual></link></robot>)");
  ImportOptions options;
  options.package_dirs = {folder_ / "packages", folder_ / "packages/"};
  const std::string text = complaint(file, options);
  for (const char* place :
       {"packages/arm/meshes/a.stl", "packages/meshes/a.stl", "packages/a.stl"}) {
    const std::size_t first = text.find(folder_ / place);
    ASSERT_NE(first, text.npos) << place << " in\n" << text;
    EXPECT_EQ(text.find(folder_ / place, first + 1), text.npos) << place << " in\n" << text;
  }
}

TEST_F(RobotOptions, macros_and_unknown_materials_of_urdf_are_told) {
  EXPECT_TRUE(has(mistakes_of(R"(<robot name="r" xmlns:xacro="x"><xacro:include filename="y"/>
    <link name="a"/></robot>)"),
                  "<xacro:include filename=\"y\">: is a macro: expand the file first"));
  const Model model = model_of(R"(<robot name="r"><link name="a"><visual><geometry>
    <sphere radius="1"/></geometry><material name="chrome"/></visual></link></robot>)",
                               "r.urdf");
  EXPECT_TRUE(has(model_as_text(model), "unknown colour \"chrome\""));
}

TEST_F(RobotOptions, poses_may_be_relative_to_what_stands_in_an_included_model) {
  write("cup.sdf", R"(<sdf version="1.9"><model name="cup"><frame name="rim"><pose>0 0 2 0 0 0
    </pose></frame><link name="l"><pose>0 0 1 0 0 0</pose><visual name="v"><geometry><sphere>
    <radius>2</radius></sphere></geometry></visual></link></model></sdf>)");
  const std::string ball = R"(<visual name="v"><geometry><sphere><radius>1</radius></sphere>
    </geometry></visual>)";
  const std::string file = write("w.sdf", R"(<sdf version="1.9"><world name="w">
    <model name="on_rim"><pose relative_to="a::rim">1 0 0 0 0 0</pose><link name="l">)" +
                                              ball + R"(
    </link></model>
    <model name="on_cup"><pose relative_to="cup::l">0 0 0 0 0 0</pose><link name="l">)" +
                                              ball + R"(
    </link></model>
    <include><uri>cup.sdf</uri><name>a</name><pose>10 0 0 0 0 0</pose></include>
    <include><uri>cup.sdf</uri><pose relative_to="a">0 5 0 0 0 0</pose></include>
    <include><uri>cup.sdf</uri><name>placed</name><placement_frame>rim</placement_frame>
      <pose>0 0 0 0 0 0</pose></include></world></sdf>)");
  std::map<std::string, Vec3<double>> at;
  for (const Object& object : import_scene(file).scene.objects)
    at[object.name] = object.pose.translation;
  EXPECT_EQ(at.at("a::l::v"), Vec3<double>(10, 0, 1));
  EXPECT_EQ(at.at("on_rim::l::v"), Vec3<double>(11, 0, 2));
  EXPECT_EQ(at.at("cup::l::v"), Vec3<double>(10, 5, 1));
  EXPECT_EQ(at.at("on_cup::l::v"), Vec3<double>(10, 5, 1));
  EXPECT_EQ(at.at("placed::l::v"), Vec3<double>(0, 0, -1));
  const std::string wrong = write("x.sdf", R"(<sdf version="1.9"><world name="w">
    <include><uri>cup.sdf</uri><pose relative_to="table">0 0 0 0 0 0</pose></include></world></sdf>)");
  const std::string text = complaint(wrong, {});
  EXPECT_TRUE(has(text, "line 2: <model name=\"cup\">: no frame is named \"table\""));
}

TEST_F(RobotOptions, a_part_of_a_mesh_that_sdf_asks_for_is_told_not_to_be_singled_out) {
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  const std::string file = write("m.sdf", R"(<sdf version="1.6"><model name="m"><link name="l">
    <visual name="v"><geometry><mesh><uri>m.obj</uri><submesh><name>lid</name></submesh></mesh>
    </geometry></visual></link></model></sdf>)");
  const std::string text = model_as_text(*import_scene(file).model);
  EXPECT_TRUE(has(text, "<mesh>: has no part \"lid\": the whole mesh is used"));
}

TEST_F(RobotOptions, a_mesh_that_is_there_in_another_format_is_told_to_be) {
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  const std::string file = write("r.urdf", R"(<robot name="r"><link name="a"><visual><geometry>
    <mesh filename="m.dae"/></geometry></visual></link></robot>)");
  const std::string text = model_as_text(*import_scene(file).model);
  EXPECT_TRUE(has(text, "m.dae (found as m.obj): 4 vertices"));
}

TEST_F(RobotOptions, rows_of_json_say_what_is_wrong_with_a_value) {
  const std::string file = write("r.urdf", gripper);
  ImportOptions options;
  options.joint_rows = write("rows.json", R"([{"left": "far"}, {"left": [1, 2]}, {"lid": 1}])");
  const std::string text = complaint(file, options);
  expect_parts(text, {"/0/left: must be a number", "/1/left: must be a list of 1",
                      "/2/lid: no joint has this name"});
}

TEST_F(RobotOptions, an_sdf_model_is_the_file_that_its_config_names) {
  for (const char* folder : {"models", "models/cup"})
    std::filesystem::create_directory(folder_ / folder);
  write("models/cup/model.config",
        "<model><name>cup</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.6'> cup-1_6.sdf "
        "</sdf></model>");
  write("models/cup/cup-1_6.sdf",
        "<sdf version='1.6'><model name='cup'><link name='l'><visual name='v'><geometry><sphere>"
        "<radius>2</radius></sphere></geometry></visual></link></model></sdf>");
  const std::string file = write(
      "w.sdf",
      "<sdf version='1.6'><world name='w'><include><uri>model://cup</uri></include></world></sdf>");
  ImportOptions options;
  options.package_dirs = {folder_ / "models"};
  const Imported imported = import_scene(file, options);
  ASSERT_EQ(imported.scene.objects.size(), 1u);
  EXPECT_EQ(imported.scene.objects[0].shape.support(Vec3<double>(1, 0, 0)).x(), 2);
  write("models/cup/model.config", "<model><sdf version='1.6'>gone.sdf</sdf></model>");
  EXPECT_TRUE(has(complaint(file, options), "no <sdf> file found (got \"gone.sdf\")"));
}

}  // namespace
}  // namespace minkray
