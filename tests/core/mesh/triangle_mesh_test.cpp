// SPDX-License-Identifier: MIT
#include "core/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include "core/mesh/weld.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

std::string refused(std::vector<Vec3<double>> vertices, std::vector<Corners> triangles) {
  return message_of<std::invalid_argument>(
      [&] { TriangleMesh(std::move(vertices), std::move(triangles)); });
}

TEST(TriangleMesh, refuses_what_is_none_and_says_where) {
  const std::vector<Vec3<double>> good = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(refused(good, {{0, 1, 2}}), "");
  EXPECT_EQ(refused(good, {}), "triangles: must be at least one (got none)");
  EXPECT_EQ(refused(good, {{0, 1, 2}, {0, 1, 3}}),
            "triangles[1]: must be numbers of vertices, less than 3 (got 3)");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{0, 1, 2}}),
            "vertices[1]: must be finite and at most 2^300");
  EXPECT_EQ(refused({{0, 0, 0}, {1e200, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
            "vertices[1]: must be finite and at most 2^300");
  EXPECT_EQ(refused({{0, 0, 0}, {1e-90, 0, 0}, {0, 1e-90, 0}}, {{0, 1, 2}}),
            "vertices: must be further apart than 2^-250");
}

TEST(TriangleMesh, counts_its_faults) {
  testing::Surface block = testing::block({1, 2, 3});
  MeshFaults faults = block.mesh().faults();
  EXPECT_TRUE(faults.is_closed());
  EXPECT_EQ(faults.without_area + faults.repeated, 0u);
  block.triangles.push_back(block.triangles[0]);
  block.triangles.push_back({0, 0, 1});
  faults = block.mesh().faults();
  EXPECT_EQ(faults.repeated, 1u);
  EXPECT_EQ(faults.without_area, 1u);
  EXPECT_TRUE(faults.is_closed());
  block.triangles.resize(11);
  EXPECT_EQ(block.mesh().faults().open_edges, 3u);
}

TEST(TriangleMesh, is_closed_though_each_triangle_has_vertices_of_its_own) {
  const testing::Surface block = testing::block({1, 2, 3});
  testing::Surface apart;
  for (const Corners& corners : block.triangles) {
    for (const std::uint32_t corner : corners) apart.vertices.push_back(block.vertices[corner]);
    const auto last = static_cast<std::uint32_t>(apart.vertices.size());
    apart.triangles.push_back({last - 3, last - 2, last - 1});
  }
  EXPECT_TRUE(apart.mesh().faults().is_closed());
  weld(apart.vertices, apart.triangles);
  EXPECT_EQ(apart.vertices.size(), 8u);
  EXPECT_EQ(apart.triangles.size(), 12u);
  EXPECT_TRUE(apart.mesh().faults().is_closed());
}

TEST(TriangleMesh, has_normals_of_slivers) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 1, 0}, {2, 2, 1e-14}}, {{0, 1, 2}});
  EXPECT_NEAR((mesh.normal(0) - Vec3<double>(1, -1, 0).normalized()).norm(), 0, 1e-13);
}

TEST(TriangleMesh, takes_so_many_bytes_a_triangle) {
  const TriangleMesh mesh = testing::torus(300, 200).mesh();
  EXPECT_LT(double(mesh.bytes()) / double(mesh.size()), 70);
}

}  // namespace
}  // namespace minkray
