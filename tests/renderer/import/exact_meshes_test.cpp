// SPDX-License-Identifier: MIT
// Robots' meshes as they are: the triangles of each format are at the place of the hull.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "core/mesh/mesh_ray.h"
#include "renderer/import/import.h"
#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/import/model_info.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

class ExactMeshes : public ::testing::Test {
 protected:
  ExactMeshes() { options_.meshes = MeshChoice::exact; }

  MeshLibrary::Answer read(const std::string& file, const Vec3<double>& scale = {1, 1, 1}) {
    MeshLibrary library(folder_.path(), options_);
    return library.parts_of(file, scale);
  }
  void expect_closed(const MeshLibrary::Answer& answer, std::size_t triangles) {
    ASSERT_EQ(answer.complaint, "");
    ASSERT_EQ(answer.parts.size(), 1u);
    ASSERT_TRUE(answer.parts[0].surface);
    EXPECT_FALSE(answer.parts[0].hull);
    const TriangleMesh& surface = *answer.parts[0].surface;
    EXPECT_EQ(surface.size(), triangles);
    EXPECT_TRUE(surface.is_closed());
    // Counter-clockwise as seen from outside: a ray from there comes in at a front.
    PartCounts counts;
    const PartHit hit = closest_part(surface, {{5, 0.1, 0.2}, {-1, 0, 0}}, 0, counts);
    ASSERT_TRUE(hit.found());
    EXPECT_FALSE(hit.is_back);
  }

  TemporaryFolder folder_;
  ImportOptions options_;
};

std::string obj_of(const testing::Surface& surface) {
  std::string text;
  for (const Vec3<double>& v : surface.vertices)
    text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
            std::to_string(v.z()) + "\n";
  for (const Corners& t : surface.triangles)
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  return text;
}

void write_stl(const std::filesystem::path& file, const testing::Surface& surface) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  add(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const Corners& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) add(0.0f);
    for (const std::uint32_t corner : t)
      for (int k = 0; k < 3; ++k) add(static_cast<float>(surface.vertices[corner][k]));
    add(std::uint16_t{0});
  }
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(ExactMeshes, are_those_of_obj_and_stl) {
  const testing::Surface block = testing::block({1, 2, 3});
  std::ofstream(folder_ / "b.obj") << obj_of(block);
  write_stl(folder_ / "b.stl", block);
  expect_closed(read("b.obj"), 12);
  expect_closed(read("b.stl"), 12);
  EXPECT_EQ(read("b.stl").parts[0].surface->vertices().size(), 8u);
  // A mirror turns triangles over, which are turned back.
  expect_closed(read("b.stl", {-1, 1, 1}), 12);
  const MeshLibrary::Answer flat = read("b.stl", {1, 0, 0});
  EXPECT_FALSE(flat.parts[0].surface);
  EXPECT_TRUE(flat.parts[0].hull);
  EXPECT_NE(std::ranges::find(flat.notes, "has no triangles: its hull is used"), flat.notes.end());
  options_.meshes = MeshChoice::hull;
  EXPECT_FALSE(read("b.stl").parts[0].surface);
  // A split makes hulls, unless triangles are requested.
  options_.meshes = MeshChoice::of_format;
  EXPECT_TRUE(read("b.stl").parts[0].surface);
  options_.split = MeshSplit::components;
  EXPECT_FALSE(read("b.stl").parts[0].surface);
}

TEST_F(ExactMeshes, are_those_of_collada) {
  // A tetrahedron of a polygon list, a strip and a triangle, on a node that is mirrored.
  std::ofstream(folder_ / "t.dae") << R"(<COLLADA><asset><up_axis>Z_UP</up_axis></asset>
    <library_geometries><geometry id="g"><mesh>
    <source id="s"><float_array id="a" count="12">2 0 0  -1 2 -1  -1 -2 -1  -1 0 2</float_array>
    <technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
    <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3</vcount><p>0 2 1</p></polylist>
    <tristrips count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>2 3 1 0</p></tristrips>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 3 2</p></triangles>
    </mesh></geometry></library_geometries>
    <library_visual_scenes><visual_scene id="w"><node><matrix>1 0 0 0 0 -1 0 0 0 0 1 0 0 0 0 1</matrix>
    <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
    <scene><instance_visual_scene url="#w"/></scene></COLLADA>)";
  expect_closed(read("t.dae"), 4);
}

TEST_F(ExactMeshes, keep_their_holes_where_a_scale_flattens_them) {
  std::ofstream(folder_ / "ring.obj") << obj_of(testing::torus(24, 12));
  const MeshLibrary::Answer answer = read("ring.obj", {1, 2, 0});
  ASSERT_TRUE(answer.parts[0].surface);
  const TriangleMesh& ring = *answer.parts[0].surface;
  EXPECT_EQ(ring.bounds().upper.z(), 0);
  PartCounts counts;
  EXPECT_FALSE(closest_part(ring, {{0, 0.1, 2}, {0, 0, -1}}, 0, counts).found());
  EXPECT_EQ(closest_part(ring, {{1, 0.1, 2}, {0, 0, -1}}, 0, counts).t, 2);
  EXPECT_FALSE(read("ring.obj", {1, 0, 0}).parts[0].surface);  // no triangle has area
}

TEST_F(ExactMeshes, are_convex_only_if_they_are_their_hulls) {
  std::ofstream(folder_ / "block.obj") << obj_of(testing::block({1, 2, 3}));
  std::ofstream(folder_ / "ring.obj") << obj_of(testing::torus(24, 12));
  std::ofstream(folder_ / "two.obj") << "v 0 0 0\nv 1 0 0\nf 1 2\n";
  // A notch along one side: all vertices lie on the hull.
  std::ofstream(folder_ / "notch.obj")
      << "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 0 4 0\n"
         "v 0 0 1\nv 4 0 1\nv 4 1 1\nv 1 1 1\nv 0 4 1\n"
         "f 1 4 3 2\nf 1 5 4\nf 6 7 8 9\nf 6 9 10\n"
         "f 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\n";
  const auto facts = [&](const std::string& file, std::string& text) {
    MeshLibrary library(folder_.path(), options_);
    EXPECT_EQ(library.parts_of(file, Vec3<double>(1, 1, 1)).complaint, "");
    Model model;
    library.hand_over(model);
    text = meshes_as_text(model.meshes);
    return facts_of(model.meshes.at(0));
  };
  std::string text;
  EXPECT_LT(facts("block.obj", text).overshoot, 1e-12);
  EXPECT_TRUE(has(text, "; convex; 12 triangles, closed")) << text;
  // The lid over the hole is furthest in its middle.
  const double of_lid = std::hypot(1, 0.4) - 0.4;
  const MeshFacts ring = facts("ring.obj", text);
  EXPECT_LE(ring.overshoot, of_lid + 0.01);
  EXPECT_GE(ring.overshoot, of_lid - 0.2);
  EXPECT_TRUE(has(text, "larger than the mesh; 576 triangles, closed")) << text;
  // The middle of the slanted facet is (2, 2.5); the nearest points are in the notch.
  const MeshFacts notch = facts("notch.obj", text);
  EXPECT_GT(notch.overshoot, 0.5);
  EXPECT_TRUE(notch.is_closed());
  EXPECT_FALSE(has(text, "; convex;")) << text;
  facts("two.obj", text);
  EXPECT_FALSE(has(text, "closed")) << text;
}

TEST_F(ExactMeshes, stand_in_scenes_of_robots) {
  write_stl(folder_ / "ring.stl", testing::torus(24, 12));
  std::ofstream(folder_ / "r.urdf") << R"(<robot name="r"><link name="a">
    <visual><geometry><mesh filename="ring.stl" scale="0.5 0.5 0.5"/></geometry></visual></link></robot>)";
  const Imported exact = import_scene(folder_ / "r.urdf", options_);
  ASSERT_EQ(exact.scene.objects.size(), 1u);
  ASSERT_TRUE(exact.scene.objects[0].mesh);
  EXPECT_EQ(exact.scene.objects[0].mesh->size(), 576u);
  EXPECT_NEAR(exact.scene.objects[0].mesh->bounds().upper.x(), 0.7, 1e-6);
  EXPECT_TRUE(import_scene(folder_ / "r.urdf", {}).scene.objects[0].mesh);
  options_.meshes = MeshChoice::hull;
  const Imported hull = import_scene(folder_ / "r.urdf", options_);
  EXPECT_FALSE(hull.scene.objects[0].mesh);
  // Both are framed alike.
  EXPECT_NEAR((exact.scene.camera.position - hull.scene.camera.position).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace minkray
