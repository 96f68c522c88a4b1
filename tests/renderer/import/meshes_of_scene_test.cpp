// SPDX-License-Identifier: MIT
// Distance of a scene file's meshes from convexity.
#include "renderer/import/meshes_of_scene.h"
#include "renderer/import/model/mesh_hull.h"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/plane_tree.h"
#include "renderer/import/model_info.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/random.h"

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
  EXPECT_EQ(meshes[0].parts.size(), 2u);
  EXPECT_NEAR(facts_of(meshes[0]).deepest, 1 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(facts_of(meshes[0]).hull_points, 8u);
  EXPECT_EQ(meshes[1].parts.size(), 1u);
  EXPECT_EQ(meshes[1].vertices, 9u);
  // In the hull of both the roof is far, and the vertex lies 1 under the other sides.
  EXPECT_NEAR(facts_of(meshes[1]).deepest, 1, 1e-12);
  EXPECT_EQ(facts_of(meshes[1]).hull_points, 6u);
  EXPECT_TRUE(has(meshes_as_text(meshes), "8 of 2 hulls; convex hull up to 0.577"));
}

TEST(MeshesOfScene, the_deepest_vertex_is_that_which_a_look_at_all_planes_finds) {
  testing::Random random(11);
  for (const double offset : {0.0, 1000.0}) {
    std::vector<PlaneTree::Plane> planes;
    std::vector<Vec3<double>> points;
    for (int i = 0; i < 2000; ++i) {
      const Vec3<double> n = random.direction();
      planes.push_back({n.x(), n.y(), n.z(), 1 + random.uniform() + offset * n.x()});
      points.push_back(1.2 * random.in_cube() + Vec3<double>(offset, 0, 0));
    }
    planes.push_back({std::nan(""), 0, 0, -10});
    const PlaneTree tree(planes, 1 + offset);
    planes.pop_back();
    int outside = 0;
    for (const Vec3<double>& point : points) {
      double least = std::numeric_limits<double>::infinity();
      for (const PlaneTree::Plane& p : planes)
        least = std::min(least, p[3] - (p[0] * point.x() + p[1] * point.y() + p[2] * point.z()));
      EXPECT_EQ(tree.least_depth(point, -1e9), least);
      const double enough = tree.least_depth(point, 0.1);
      EXPECT_TRUE(least <= 0.1 ? enough >= least && enough <= 0.1 : enough == least) << least;
      outside += least < 0 ? 1 : 0;
    }
    EXPECT_GT(outside, 200);
    EXPECT_LT(outside, 1800);
  }
  EXPECT_EQ(PlaneTree({}, 1).least_depth({0, 0, 0}, 0), std::numeric_limits<double>::infinity());
}

TEST(MeshesOfScene, vertices_of_the_hull_lie_below_nothing) {
  const TemporaryFolder folder;
  testing::Random random(12);
  std::ofstream obj(folder / "m.obj");
  obj.precision(17);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> n = random.direction();
    obj << "v " << n.x() << " " << n.y() << " " << n.z() << "\n";
  }
  obj.close();
  const ImportOptions options;
  MeshLibrary library(folder.path(), options);
  EXPECT_EQ(library.parts_of("m.obj", Vec3<double>(1, 2, -3)).complaint, "");
  Model model;
  library.hand_over(model);
  const std::vector<ModelMesh>& meshes = model.meshes;
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(facts_of(meshes[0]).hull_points, 300u);
  EXPECT_EQ(facts_of(meshes[0]).deepest, 0);
}

}  // namespace
}  // namespace minkray
