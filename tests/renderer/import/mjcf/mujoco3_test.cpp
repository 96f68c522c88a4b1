// SPDX-License-Identifier: MIT
// Additions to MJCF since MuJoCo 2.2: replicas, attached models, builtin meshes, fitted
// primitives. Expected numbers are the closed forms of MuJoCo's XML reference.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/import/model/mesh_hull.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

TEST(Mujoco3, replicas_stand_a_turn_and_a_step_further_each) {
  const Model model = model_of(mjcf("<replicate count=\"12\" euler=\"0 0 30\" offset=\"0 0 0.1\" "
                                    "sep=\"-\"><replicate count=\"2\" "
                                    "offset=\"1 0 0\"><body name=\"b\" pos=\"2 0 0\"><geom "
                                    "name=\"g\" size=\"0.1\"/></body></replicate></replicate>"),
                               "m.xml");
  ASSERT_EQ(model.links.size(), 24u);
  EXPECT_EQ(model.links[0].name, "b0-00");
  EXPECT_EQ(model.links[23].name, "b1-11");
  EXPECT_EQ(model.geoms[23].name, "g1-11");
  const std::vector<Affine<double>> poses = link_poses(model);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double angle = double(i) * std::numbers::pi / 6, r = 2 + double(j);
      const Vec3<double> expected(r * std::cos(angle), r * std::sin(angle), 0.1 * double(i));
      EXPECT_LT((poses[2 * i + j].translation - expected).norm(), 1e-14);
    }
  // Steps turn with the replicas.
  const Model spiral = model_of(mjcf("<replicate count=\"3\" euler=\"0 0 90\" offset=\"1 0 "
                                     "0\"><geom size=\"0.1\"/></replicate>"),
                                "m.xml");
  EXPECT_LT((spiral.geoms[2].pose.translation - Vec3<double>(1, 1, 0)).norm(), 1e-15);
  EXPECT_TRUE(
      has(mistakes_of(mjcf("<replicate count=\"1e9\"><geom size=\"1\"/></replicate>"), "m.xml"),
          "count:"));
}

TEST_F(MeshFolder, attached_models_keep_their_own_settings) {
  std::filesystem::create_directories(folder.path() / "parts/meshes");
  std::filesystem::copy_file(folder / "two.obj", folder.path() / "parts/meshes/two.obj");
  folder.write(
      "parts/part.xml",
      R"(<mujoco><compiler angle="radian" meshdir="meshes"/><default><geom rgba="1 0 0 1"/></default>
    <asset><mesh file="two.obj"/></asset><worldbody><frame name="f" pos="0 0 1"><geom type="mesh" mesh="two"/></frame>
    <body name="b" euler="0 0 1.5707963267948966"><geom type="sphere" size="0.1" pos="1 0 0"/><joint name="h"/></body></worldbody></mujoco>)");
  const Imported whole =
      import("m.xml", R"(<mujoco><asset><model name="p" file="parts/part.xml"/></asset><worldbody>
    <geom size="0.1"/><body name="host" pos="0 0 5"><attach model="p" body="b" prefix="one_"/><attach model="p" frame="f" prefix="two_"/>
    </body><attach model="p" prefix="three_"/></worldbody></mujoco>)");
  const Model& model = *whole.model;
  std::vector<std::string> names;
  for (const ModelLink& link : model.links) names.push_back(link.name);
  EXPECT_EQ(names, (std::vector<std::string>{"host", "one_b", "three_b"}));
  EXPECT_EQ(model.links[1].joints.at(0).name, "one_h");
  EXPECT_EQ(model.geoms.size(), 5u);
  const std::vector<Affine<double>> poses = link_poses(model);
  EXPECT_LT((poses[1](Vec3<double>(1, 0, 0)) - Vec3<double>(0, 1, 5)).norm(), 1e-15);
  std::size_t red = 0;
  for (const ModelGeom& geom : model.geoms) red += geom.rgba == Rgba{1, 0, 0, 1} ? 1 : 0;
  EXPECT_EQ(red, 4u);
  // Without end.
  const std::string message = complaint(
      folder.write("self.xml", R"(<mujoco><worldbody><body name="b"><attach body="b" prefix="p"/>
    <attach body="b" prefix="q"/></body></worldbody></mujoco>)"));
  EXPECT_TRUE(has(message, "in a cycle"));
}

TEST_F(MeshFolder, meshes_of_an_included_file_may_lie_beside_it) {
  std::filesystem::create_directories(folder.path() / "arm/assets");
  std::filesystem::copy_file(folder / "two.obj", folder.path() / "arm/assets/arm.obj");
  folder.write(
      "arm/arm.xml",
      R"(<mujoco><include file="more.xml"/><asset><mesh file="arm.obj"/></asset></mujoco>)");
  folder.write("arm/more.xml",
               R"(<mujoco><worldbody><geom type="mesh" mesh="arm"/></worldbody></mujoco>)");
  for (const char* settings : {"", "<compiler meshdir=\"assets\"/>"}) {
    if (*settings == '\0')
      std::filesystem::copy_file(folder / "two.obj", folder.path() / "arm/arm.obj");
    EXPECT_EQ(complaint(folder.write("scene.xml", std::string("<mujoco>") + settings +
                                                      "<include file=\"arm/arm.xml\"/></mujoco>")),
              "");
  }
}

TEST(Mujoco3, builtin_meshes_are_their_vertices) {
  const auto model = [](const std::string& attributes) {
    return model_of(mjcf("<geom type=\"mesh\" mesh=\"m\"/>",
                         "<asset><mesh name=\"m\" " + attributes + "/></asset>"),
                    "m.xml");
  };
  EXPECT_EQ(model("builtin=\"sphere\" params=\"2\"").meshes.at(0).vertices, 162u);
  EXPECT_EQ(model("builtin=\"hemisphere\" params=\"3\"").meshes.at(0).vertices, 41u);
  EXPECT_EQ(facts_of(model("builtin=\"cone\" params=\"6 0\"").meshes.at(0)).hull_points, 7u);
  EXPECT_EQ(
      facts_of(model("builtin=\"cone\" params=\"6 1\" scale=\"1 1 2\"").meshes.at(0)).hull_points,
      12u);
  EXPECT_EQ(model("builtin=\"plate\" params=\"3 4\"").meshes.at(0).vertices, 12u);
  EXPECT_EQ(model("builtin=\"supersphere\" params=\"8 1 1\"").meshes.at(0).vertices, 58u);
  const std::string wrong =
      mistakes_of(mjcf("<geom type=\"mesh\" mesh=\"m\"/>",
                       "<asset><mesh name=\"m\" builtin=\"sphere\" params=\"9\"/></asset>"),
                  "m.xml");
  EXPECT_TRUE(has(wrong, "a subdivision from 0 to 4"));
}

/// A primitive fitted to a mesh of its own kind has its size.
TEST(Mujoco3, primitives_are_fitted_to_meshes) {
  const std::string brick =
      "<asset><mesh name=\"m\" vertex=\"-1 -2 -3 1 -2 -3 -1 2 -3 1 2 -3 -1 -2 3 1 -2 3 -1 2 3 1 2 "
      "3\"/></asset>";
  for (const std::string fit : {"", "<compiler fitaabb=\"true\"/>"}) {
    const Model box =
        model_of(mjcf("<geom type=\"box\" mesh=\"m\" pos=\"5 0 0\"/>", fit + brick), "m.xml");
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<double> n = Vec3<double>::Unit(axis);
      const Affine<double>& pose = box.geoms.at(0).pose;
      const double reach = (pose(support_of(box.geoms[0], pose.linear.transpose() * n))).dot(n);
      EXPECT_NEAR(reach, 1.0 + axis + (axis == 0 ? 5 : 0), 1e-12) << fit;
    }
    const Model half = model_of(
        mjcf("<geom type=\"ellipsoid\" mesh=\"m\" fitscale=\"0.5\"/>", fit + brick), "m.xml");
    EXPECT_NEAR(std::get<Ellipsoid>(half.geoms.at(0).shape->kind).radii.maxCoeff(), 1.5, 1e-12);
    EXPECT_EQ(kind_of(model_of(mjcf("<geom type=\"capsule\" mesh=\"m\"/>", fit + brick), "m.xml")),
              "capsule");
  }
}

TEST(Mujoco3, what_is_newer_is_told_with_its_version) {
  for (const char* element : {"<flexcomp/>", "<flex/>"})
    EXPECT_TRUE(has(mistakes_of(mjcf(element), "m.xml"), "MuJoCo 3.0")) << element;
  EXPECT_TRUE(has(mistakes_of("<mujoco><deformable/></mujoco>", "m.xml"), "MuJoCo 3.0"));
}

TEST(Mujoco, bodies_without_a_place_are_where_their_mass_is) {
  const auto at = [](const std::string& body) {
    const Model model = model_of(
        "<mujoco><compiler coordinate=\"global\"/><worldbody>" + body + "</worldbody></mujoco>",
        "m.xml");
    return link_poses(model).at(0).translation;
  };
  EXPECT_LT((at("<body><geom size=\"1\" pos=\"1 2 3\"/></body>") - Vec3<double>(1, 2, 3)).norm(),
            1e-15);
  EXPECT_LT((at("<body><geom size=\"1\" pos=\"0 0 0\" mass=\"1\"/><geom size=\"2\" pos=\"4 0 0\" "
                "mass=\"3\"/></body>") -
             Vec3<double>(3, 0, 0))
                .norm(),
            1e-15);
  EXPECT_LT((at("<body><inertial pos=\"7 0 0\" mass=\"1\"/><geom size=\"1\"/></body>") -
             Vec3<double>(7, 0, 0))
                .norm(),
            1e-15);
  EXPECT_TRUE(
      has(mistakes_of(
              "<mujoco><compiler coordinate=\"global\"/><worldbody><body/></worldbody></mujoco>",
              "m.xml"),
          "pos: missing"));
}

}  // namespace
}  // namespace minkray
