// SPDX-License-Identifier: MIT
// SDF's frames, compared with the specification, and with libsdformat where it is installed.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <stdexcept>

#include "tests/oracle/sdformat_links.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/program.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

/// Frames of all kinds, in a model within a model.
constexpr const char* framed = R"(<sdf version="1.9"><model name="m"><pose>1 2 3 0.1 0.2 0.3</pose>
  <frame name="f" attached_to="base"><pose>0 0 1 0 0.5 0</pose></frame>
  <frame name="g" attached_to="f"/>
  <link name="base"><pose>0 2 0 0.3 0 0</pose></link>
  <link name="tip"><pose relative_to="g">0 0 0.5 0 0 1.5</pose>
    <visual name="v"><pose relative_to="f">0.25 0 0 0 0 0</pose>
      <geometry><sphere><radius>0.1</radius></sphere></geometry></visual></link>
  <link name="leaf"><pose relative_to="j">0 1 0 0.4 0 0</pose></link>
  <link name="deep"><pose relative_to="inner::x">0 0 1 0 0 0</pose></link>
  <joint name="j" type="revolute"><pose>0.1 0 0 0 0 0.7</pose><parent>base</parent>
    <child>tip</child><axis><xyz expressed_in="f">0 1 0</xyz></axis></joint>
  <joint name="k" type="prismatic"><parent>g</parent><child>leaf</child>
    <axis><xyz>1 1 0</xyz></axis></joint>
  <joint name="l" type="fixed"><parent>tip</parent><child>inner::x</child></joint>
  <model name="inner" placement_frame="x"><pose relative_to="tip">1 0 0 0 0 0.2</pose>
    <link name="x"><pose>0 0 2 0 0.1 0</pose></link><link name="y"/></model>
  </model></sdf>)";

constexpr const char* old_axes = R"(<sdf version="1.4"><model name="m"><link name="a"/>
  <link name="b"><pose>0 0 1 0 0 1.5707963267948966</pose></link>
  <joint name="j" type="revolute"><parent>a</parent><child>b</child>
    <axis><xyz>1 0 0</xyz></axis></joint></model></sdf>)";

constexpr const char* world_of_two = R"(<sdf version="1.8"><world name="w">
  <frame name="f"><pose>0 0 5 0 0 0.3</pose></frame>
  <model name="a"><pose relative_to="f">1 0 0 0 0 0</pose><link name="l"/></model>
  <model name="b"><pose relative_to="a">0 1 0 0 0 0</pose><link name="l"/></model></world></sdf>)";

Model sdf_model(const std::string& text) {
  return model_of(text, "m.sdf");
}

std::map<std::string, Affine<double>> links_of(const Model& model) {
  std::map<std::string, Affine<double>> at;
  const auto poses = link_poses(model);
  for (std::size_t i = 0; i < poses.size(); ++i) at[model.links[i].name] = poses[i];
  return at;
}

TEST(Sdf, nested_frames_placement_frames_and_scoped_names_are_read) {
  const Model model = sdf_model(framed);
  const auto at = links_of(model);
  ASSERT_EQ(at.size(), 6u);
  // The inner model's frame x is at the inner model's place.
  const Affine<double> tip = at.at("m::tip"), x = at.at("m::inner::x");
  EXPECT_LT(((tip.inverse() * x).translation - Vec3<double>(1, 0, 0)).norm(), 1e-14);
  EXPECT_LT(((x.inverse() * at.at("m::deep")).translation - Vec3<double>(0, 0, 1)).norm(), 1e-14);
  // A shape may be in another frame than its link's.
  ASSERT_EQ(model.geoms.size(), 1u);
  const Affine<double> base = at.at("m::base");
  const Vec3<double> expected =
      base(Vec3<double>(0, 0, 1) + 0.25 * Vec3<double>(std::cos(0.5), 0, -std::sin(0.5)));
  EXPECT_LT((tip(model.geoms[0].pose.translation) - expected).norm(), 1e-14);
  // Frames as joints' ends represent the links that they are fixed to.
  for (const ModelLink& link : model.links)
    if (link.name == "m::leaf") {
      EXPECT_EQ(model.links[static_cast<std::size_t>(link.parent)].name, "m::base");
    }
}

TEST(Sdf, axes_were_the_models_up_to_version_1_4) {
  const auto axis_of = [](const Model& model) { return model.links[1].joints.at(0).axis; };
  EXPECT_LT((axis_of(sdf_model(old_axes)) - Vec3<double>(0, -1, 0)).norm(), 1e-12);
  std::string newer = old_axes;
  newer.replace(newer.find("1.4"), 3, "1.5");
  EXPECT_LT((axis_of(sdf_model(newer)) - Vec3<double>(1, 0, 0)).norm(), 1e-12);
}

TEST(Sdf, models_of_a_world_stand_relative_to_each_other) {
  const auto at = links_of(sdf_model(world_of_two));
  const Vec3<double> b = at.at("b::l").translation;
  EXPECT_LT(
      (b - Vec3<double>(std::cos(0.3) - std::sin(0.3), std::sin(0.3) + std::cos(0.3), 5)).norm(),
      1e-14);
}

TEST(Sdf, frames_in_circles_are_told) {
  for (const char* text :
       {R"(<sdf version="1.9"><model name="m"><link name="a"><pose relative_to="b"/></link>
          <link name="b"><pose relative_to="a"/></link></model></sdf>)",
        R"(<sdf version="1.9"><model name="m"><link name="a"/><model name="i">
          <pose relative_to="i::x">1 0 0 0 0 0</pose><link name="x"/></model></model></sdf>)",
        R"(<sdf version="1.9"><model name="m"><link name="a"/><frame name="f" attached_to="g"/>
          <frame name="g" attached_to="f"/><joint name="j" type="fixed"><parent>a</parent>
          <child>f</child></joint></model></sdf>)"})
    EXPECT_NE(mistakes_of(text, "m.sdf"), "") << text;
}

#ifdef MINKRAY_SDFORMAT_LINKS

decltype(minkray_sdformat_links)* sdformat_links() {
  void* module = dlopen(MINKRAY_SDFORMAT_LINKS, RTLD_NOW);
  if (!module) throw std::runtime_error(dlerror());
  return reinterpret_cast<decltype(minkray_sdformat_links)*>(
      dlsym(module, "minkray_sdformat_links"));
}

/// Number of links and axes that both support.
int expect_libsdformats(const std::string& file, const Model& model) {
  static const auto read_links = sdformat_links();
  std::string why;
  testing::SdformatLinks theirs;
  if (!read_links(file, theirs, why)) return 0;
  int both = 0;
  for (const auto& [name, pose] : links_of(model)) {
    const auto found = theirs.links.find(name);
    if (found == theirs.links.end()) {
      ADD_FAILURE() << file << ": libsdformat has no link " << name;
      continue;
    }
    ++both;
    EXPECT_LT((pose.translation - found->second.translation).norm(), 1e-12) << file << " " << name;
    EXPECT_LT((pose.linear - found->second.linear).cwiseAbs().maxCoeff(), 1e-12) << file << name;
  }
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) {
      const auto found = theirs.axes.find(joint.name);
      if (found == theirs.axes.end() || width_of(joint.kind) != 1) continue;
      ++both;
      EXPECT_LT((joint.axis - unit(found->second)).norm(), 1e-12) << file << " " << joint.name;
    }
  return both;
}

TEST(Sdf, links_and_axes_are_libsdformats) {
  const TemporaryFolder folder;
  int both = 0;
  for (const auto& [name, text] :
       {std::pair{"framed.sdf", framed}, {"old.sdf", old_axes}, {"world.sdf", world_of_two}}) {
    std::ofstream(folder / name) << text;
    both += expect_libsdformats(folder / name, sdf_model(text));
  }
  EXPECT_EQ(both, 13);
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  for (const char* source : {"dart", "simbody"})
    for (const char* ending : {".sdf", ".world"})
      for (const std::string& file : robot_files(source, ending)) {
        Mistakes mistakes(file);
        if (const auto model = load_model(file, without_meshes(), mistakes))
          both += expect_libsdformats(file, *model);
      }
  EXPECT_GT(both, 100);
}

#endif

}  // namespace
}  // namespace minkray
