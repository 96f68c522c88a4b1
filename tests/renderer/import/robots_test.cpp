// SPDX-License-Identifier: MIT
// URDF and SDF: real models, small files, and mistakes in them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

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
  EXPECT_GE(read, 25);  // most of them, so that the test is meaningful
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

TEST(Urdf, mimics_follow_and_capsules_are_read) {
  const std::string text = R"(<robot name="two"><link name="a"/>
    <link name="b"><visual><geometry><capsule radius="0.1" length="0.4"/></geometry></visual></link>
    <link name="c"/>
    <joint name="ab" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
    <joint name="ac" type="prismatic"><parent link="a"/><child link="c"/><axis xyz="1 0 0"/>
      <mimic joint="ab" multiplier="2" offset="0.5"/></joint></robot>)";
  Model model = model_of(text, "robot.urdf");
  find_joint(model, "ab")->value = {1};
  follow_mimics(model);
  EXPECT_EQ(link_poses(model)[2].translation, Vec3<double>(2.5, 0, 0));
  ASSERT_EQ(model.geoms.size(), 1u);
  EXPECT_NEAR(model.geoms[0].shape->support(Vec3<double>(0, 0, 1)).z(), 0.3, 1e-15);
}

TEST(Urdf, mistakes_are_told_all_at_once_with_their_lines) {
  const std::string mistakes = mistakes_of(R"(<robot name="bad">
<link name="a"><visual><geometry><box size="1 -1 1"/></geometry></visual></link>
<link name="a"/>
<link name="b"><collision><geometry><wedge/></geometry></collision>
  <visual><geometry><mesh filename="package://none/x.stl"/></geometry></visual></link>
<joint name="j" type="revolving"><parent link="a"/><child link="absent"/></joint>
</robot>)");
  expect_parts(mistakes, {"line 2: <box>: size", "line 3: <link name=\"a\">: name: duplicate link",
                          "line 4: <wedge>: must be one of box", "searched:",
                          "line 6: <joint name=\"j\">: type", "the link \"absent\" not found"});
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
  const Model model = model_of(text, "m.sdf");
  std::map<std::string, Vec3<double>> at;
  const auto poses = link_poses(model);
  for (std::size_t i = 0; i < poses.size(); ++i) at[model.links[i].name] = poses[i].translation;
  EXPECT_LT((at["m::base"] - Vec3<double>(1, 2, 0)).norm(), 1e-15);
  EXPECT_LT((at["m::tip"] - Vec3<double>(1, 2, 1.5)).norm(), 1e-15);
  EXPECT_LT((at["m::inner::x"] - Vec3<double>(1, 3, 1.5)).norm(), 1e-15);
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
    EXPECT_EQ(
        last.mesh ? last.mesh->bounds().lower.x() : last.shape.support(Vec3<double>(-1, 0, 0)).x(),
        -11);
    EXPECT_EQ(last.mesh == nullptr, split != MeshSplit::none);
  }
}

}  // namespace
}  // namespace minkray
