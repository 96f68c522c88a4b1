// SPDX-License-Identifier: MIT
// How far from convex the meshes of a scene file are.
#include "renderer/import/meshes_of_scene.h"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/import/model_info.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

// Two tetrahedra of side 4, and a vertex at (1, 1, 1) in the first: 1 under three of its faces and
// 1 / sqrt(3) under the slanted one.
constexpr const char* two_bodies =
    "o left\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 1 1 1\nf 1 2 3\nf 1 2 4\nf 2 3 5\nf 3 4 5\n"
    "o right\nv 10 0 0\nv 14 0 0\nv 10 4 0\nv 10 0 4\nf 6 7 8\nf 6 7 9\nf 7 8 9\n";

TEST(MeshesOfScene, are_told_with_how_deep_a_vertex_lies_under_the_hull) {
  const TemporaryFolder folder;
  std::ofstream(folder / "m.obj") << two_bodies;
  std::ofstream(folder / "s.json") << R"({"objects": [
    {"shape": {"type": "hull", "file": "m.obj"}, "split": "groups"},
    {"shape": {"type": "hull", "file": "m.obj"}, "split": "groups", "name": "again"},
    {"shape": {"type": "rounded", "radius": 1, "shape": {"type": "hull", "file": "m.obj"}}},
    {"shape": {"type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}]})";
  const std::vector<ModelMesh> meshes = meshes_of_scene(folder / "s.json");
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].parts, 2u);
  EXPECT_NEAR(meshes[0].deepest, 1 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(meshes[0].corners, 8u);
  EXPECT_EQ(meshes[1].parts, 1u);
  EXPECT_EQ(meshes[1].vertices, 9u);
  // In the hull of both the roof is far, and the vertex lies 1 under the other sides.
  EXPECT_NEAR(meshes[1].deepest, 1, 1e-12);
  EXPECT_EQ(meshes[1].corners, 6u);
  EXPECT_NE(meshes_as_text(meshes).find("8 of 2 hulls; vertices up to 0.577 under the hull"),
            std::string::npos)
      << meshes_as_text(meshes);
}

}  // namespace
}  // namespace minkray
