// SPDX-License-Identifier: MIT
// COLLADA meshes, as robots' files name them.
#include <gtest/gtest.h>

#include <fstream>

#include "core/math/bounds.h"
#include "renderer/import/mesh/collada.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

/// Two tetrahedra that do not touch.
constexpr const char* two_tetrahedra = R"(<library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="24">0 0 0 1 0 0 0 2 0 0 0 3
    10 0 0 11 0 0 10 2 0 10 0 3</float_array></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="8"><input semantic="VERTEX" source="#v" offset="0"/>
    <input semantic="NORMAL" source="#v" offset="1"/>
    <p>0 0 1 0 2 0  0 0 1 0 3 0  0 0 2 0 3 0  1 0 2 0 3 0
       4 0 5 0 6 0  4 0 5 0 7 0  4 0 6 0 7 0  5 0 6 0 7 0</p></triangles>
  </mesh></geometry></library_geometries>)";

std::string dae_document(const std::string& nodes, const std::string& asset = "") {
  return "<COLLADA version='1.4.1'><asset>" + asset + "</asset>" + two_tetrahedra +
         "<library_visual_scenes><visual_scene id='s'>" + nodes +
         "</visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

MeshParts dae_mesh(const std::string& text, MeshSplit split = MeshSplit::none) {
  const TemporaryFolder folder;
  std::ofstream(folder / "m.dae") << text;
  return read_collada(folder / "m.dae", split, MeshDetail::attributes).mesh;
}

Vec3<double> largest_corner(const MeshParts& mesh) {
  Vec3<double> all = mesh.vertices[0];
  for (const Vec3<double>& vertex : mesh.vertices) all = all.cwiseMax(vertex);
  return all;
}

TEST(Collada, vertices_stand_where_nodes_put_them_in_metres) {
  const std::string node =
      "<node><translate>0 0 100</translate><scale>1 1 2</scale>"
      "<node><rotate>0 0 1 90</rotate><instance_geometry url='#g'/></node></node>";
  const MeshParts mesh = dae_mesh(dae_document(node, "<unit meter='0.01'/>"));
  EXPECT_LT((largest_corner(mesh) - Vec3<double>(0, 0.11, 1.06)).norm(), 1e-12);
}

TEST(Collada, the_up_axis_turns_nothing_as_in_rviz_gazebo_and_moveit) {
  const std::string node = "<node><instance_geometry url='#g'/></node>";
  for (const char* axis : {"", "<up_axis>Y_UP</up_axis>", "<up_axis>Z_UP</up_axis>"})
    EXPECT_EQ(largest_corner(dae_mesh(dae_document(node, axis))), Vec3<double>(11, 2, 3)) << axis;
}

TEST(Collada, parts_are_meshes_or_what_hangs_together) {
  const std::string nodes =
      "<node><instance_geometry url='#g'/></node><node><instance_geometry url='#g'/></node>";
  EXPECT_EQ(dae_mesh(dae_document(nodes), MeshSplit::none).parts.size(), 0u);
  EXPECT_EQ(dae_mesh(dae_document(nodes), MeshSplit::groups).parts.size(), 2u);
  const MeshParts pieces = dae_mesh(dae_document(nodes), MeshSplit::components);
  ASSERT_EQ(pieces.parts.size(), 4u);
  for (const auto& part : pieces.parts) EXPECT_EQ(part.size(), 4u);
}

TEST(Collada, skins_are_their_mesh_in_the_bind_pose) {
  std::string text = dae_document("<node><instance_controller url='#c'/></node>");
  text.insert(text.find("<library_visual"),
              "<library_controllers><controller id='c'><skin source='#g'><bind_shape_matrix>"
              "1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller>"
              "</library_controllers>");
  EXPECT_EQ(largest_corner(dae_mesh(text)), Vec3<double>(16, 2, 3));
}

TEST(Collada, nodes_that_show_each_other_again_and_again_are_refused_in_seconds) {
  // Each shows the one before twice: 2^60 nodes, and none of them has a vertex.
  std::string nodes = "<node id='n0'/>";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "<instance_node url='#n" + std::to_string(i - 1) + "'/>";
    nodes += "<node id='n" + std::to_string(i) + "'>" + before + before + "</node>";
  }
  EXPECT_THROW(dae_mesh(dae_document(nodes)), std::runtime_error);
  EXPECT_THROW(dae_mesh(dae_document("<node id='n'><instance_node url='#n'/></node>")),
               std::runtime_error);
  std::string wrong = dae_document("<node><instance_geometry url='#g'/></node>");
  wrong.replace(wrong.find("4 0 5 0 6 0"), 11, "4 0 5 0 8 0");
  EXPECT_THROW(dae_mesh(wrong, MeshSplit::components), std::runtime_error);
}

std::string refused_dae(const std::string& nodes, MeshSplit split = MeshSplit::none) {
  return message_of<std::runtime_error>([&] { dae_mesh(dae_document(nodes), split); });
}

/// Each level shows the next one as it is, and moved by `step`; `leaf` is the last one.
std::string shown_twice(int levels, const std::string& step, const std::string& leaf) {
  std::string nodes;
  for (int i = 0; i < levels; ++i) {
    const std::string next = "<instance_node url='#n" + std::to_string(i + 1) + "'/>";
    nodes +=
        "<node id='n" + std::to_string(i) + "'>" + next + "<node>" + step + next + "</node></node>";
  }
  return nodes + "<node id='n" + std::to_string(levels) + "'>" + leaf + "</node>";
}

TEST(Collada, a_node_is_read_once_however_often_it_is_shown) {
  // 400 transforms were read for each of 2^17 times that the leaf is shown: 4.7 s of 12.7 kB.
  std::string leaf;
  for (int i = 0; i < 400; ++i) leaf += "<translate>0 0 1</translate>";
  constexpr int levels = 8;
  const std::string nodes =
      shown_twice(levels, "<translate>0 1 0</translate>", leaf + "<instance_geometry url='#g'/>");
  const MeshParts mesh = dae_mesh(dae_document(nodes), MeshSplit::components);
  // Each of the levels' nodes is a root, too.
  std::size_t shown = 0;
  for (int i = 0; i <= levels; ++i) shown += std::size_t{1} << i;
  EXPECT_EQ(mesh.vertices.size(), 8 * shown);
  EXPECT_EQ(mesh.parts.size(), 2 * shown);
  EXPECT_EQ(largest_corner(mesh), Vec3<double>(11, 2 + levels, 3 + 400));
}

TEST(Collada, what_is_shown_again_and_again_is_told) {
  // 4 kB made 18 million vertices, all of them corners of their hull.
  EXPECT_TRUE(
      has(refused_dae(shown_twice(16, "<rotate>0 0 1 7</rotate>", "<instance_geometry url='#g'/>")),
          "must have at most 200000 vertices, of 24 numbers in the file (got 200008)"));
  EXPECT_TRUE(has(refused_dae(shown_twice(20, "", "")),
                  "must have at most 1000000 nodes and meshes, with repeated"));
}

TEST(Collada, a_robots_file_finds_its_meshes) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  ImportOptions options;
  options.package_dirs = {(robot_models() / "dart/urdf/wam").string()};
  const Imported wam = import_scene(robot_models() / "dart/urdf/wam/wam.urdf", options);
  EXPECT_GE(wam.model->meshes.size(), 8u);
  Bounds<double> bounds;
  for (const Object& object : wam.scene.objects) {
    EXPECT_FALSE(object.half_space);
    for (const Vec3<double>& n : {Vec3<double>(1, 1, 1), Vec3<double>(-1, -1, -1)})
      bounds.extend(
          object.pose(object.shape.support(Vec3<double>(object.pose.linear.transpose() * n))));
  }
  // An arm of about a metre, link upon link: parts turned about would stick out.
  EXPECT_LT(bounds.half_extents().maxCoeff(), 0.8);
}

}  // namespace
}  // namespace minkray
