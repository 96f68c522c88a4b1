// SPDX-License-Identifier: MIT
#include "core/geometry/facet_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/point_cloud.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

std::vector<Vec3<double>> on_sphere(int count) {
  Random random(51);
  std::vector<Vec3<double>> points;
  for (int i = 0; i < count; ++i) points.push_back(random.direction());
  return points;
}

std::vector<Vec3<double>> prism(int sides) {
  std::vector<Vec3<double>> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 6.283185307179586 * i / sides;
    for (const double z : {-1.0, 1.0}) points.push_back({std::cos(angle), std::sin(angle), z});
  }
  return points;
}

FacetMesh mesh_of(const std::vector<Vec3<double>>& points) {
  const ConvexHull hull = convex_hull(points);
  std::vector<Vec3<double>> vertices;
  for (const std::uint32_t v : hull.vertices) vertices.push_back(points[v]);
  return FacetMesh(hull, vertices);
}

TEST(FacetMesh, closes_and_every_neighbour_shares_the_edge) {
  for (const auto& points : {on_sphere(4), on_sphere(60), prism(3), prism(17)}) {
    const FacetMesh mesh = mesh_of(points);
    EXPECT_EQ(mesh.size(), 2 * points.size() - 4);  // Euler, for triangles
    for (std::size_t f = 0; f < mesh.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& other = mesh[mesh[f].neighbour(k)];
        ASSERT_NE(mesh[f].neighbour(k), f);
        // The neighbour walks the edge the other way round, and links back.
        bool shared = false;
        for (std::size_t j = 0; j < 3; ++j)
          shared =
              shared || (other.corner(j) == mesh[f].corner((k + 1) % 3) &&
                         other.corner((j + 1) % 3) == mesh[f].corner(k) && other.neighbour(j) == f);
        EXPECT_TRUE(shared) << f << ", side " << k;
      }
    }
  }
}

TEST(FacetMesh, normals_point_outwards) {
  for (const auto& points : {on_sphere(30), prism(9)}) {
    const FacetMesh mesh = mesh_of(points);
    for (std::size_t f = 0; f < mesh.size(); ++f) {
      EXPECT_NEAR(mesh[f].normal().norm(), 1, 1e-15);
      for (const Vec3<double>& p : points)
        EXPECT_LE(mesh[f].normal().dot(p - mesh[f].corner(0)), 1e-15);
    }
  }
}

TEST(FacetMesh, finds_a_facet_near_a_direction) {
  const FacetMesh mesh = mesh_of(on_sphere(200));
  Random random(52);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<double> n = random.direction();
    const auto found = static_cast<std::size_t>(mesh.facing(n));
    ASSERT_LT(found, mesh.size());
    EXPECT_GT(mesh[found].normal().dot(n.normalized()), 0.9);
    EXPECT_EQ(mesh.facing(Vec3<double>(n * 1e-100)), mesh.facing(n));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LT(static_cast<std::size_t>(mesh.facing(Vec3<double>(nan, nan, nan))), mesh.size());
}

/// Sides of several facets have one normal, so that no neighbour of a facet within may point nearer
/// to a direction although others do.
TEST(FacetMesh, finds_sides_of_several_facets) {
  std::vector<Vec3<double>> box;
  for (int k = 0; k < 8; ++k)
    box.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 0.8 : -0.8, k & 4 ? 0.6 : -0.6});
  Random random(53);
  for (const auto& points : {box, prism(5), prism(64)}) {
    const FacetMesh mesh = mesh_of(points);
    for (int i = 0; i < 1000; ++i) {
      const Vec3<double> n = random.direction();
      const auto found = static_cast<std::size_t>(mesh.facing(n));
      double nearest = 0;
      for (std::size_t f = 0; f < mesh.size(); ++f)
        nearest = std::max(nearest, mesh[f].normal().dot(n));
      EXPECT_GT(mesh[found].normal().dot(n), nearest - 0.6) << n.transpose();
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (points.size() != box.size()) continue;
      const auto found =
          static_cast<std::size_t>(mesh.facing(Vec3<double>(Vec3<double>::Unit(axis))));
      EXPECT_NEAR(mesh[found].normal()[axis], 1, 1e-15);
    }
  }
}

/// The point furthest along a facet's normal is its first corner, or the facet is marked as
/// unsupported.
void expect_supported(const std::vector<Vec3<double>>& points) {
  const PointCloud cloud(points);
  const FacetMesh& mesh = *cloud.facets();
  std::size_t supported = 0;
  for (std::size_t f = 0; f < mesh.size(); ++f) {
    const Vec3<double> n = mesh[f].normal();
    double furthest = -std::numeric_limits<double>::infinity();
    for (const Vec3<double>& point : cloud.points()) furthest = std::max(furthest, n.dot(point));
    if (mesh[f].is_supported()) {
      EXPECT_GE(n.dot(mesh[f].corner(0)), furthest) << f;
    }
    supported += mesh[f].is_supported() ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(std::count(cloud.points().begin(), cloud.points().end(), mesh[f].corner(k)), 1);
  }
  EXPECT_GE(supported, mesh.size() / 3);
}

TEST(FacetMesh, knows_which_corner_supports_a_facet) {
  for (const auto& points : {on_sphere(12), on_sphere(300), prism(9), prism(40)}) {
    expect_supported(points);
  }
}

TEST(FacetMesh, rows_are_the_facets) {
  const FacetMesh mesh = mesh_of(on_sphere(20));
  for (std::size_t f = 0; f < mesh.size(); ++f) {
    const auto row = mesh.numbers<0, 16>(static_cast<double>(f));
    const auto last = mesh.numbers<12, 4>(static_cast<double>(f));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(Vec3<double>(row[3 * k], row[3 * k + 1], row[3 * k + 2]), mesh[f].corner(k));
    EXPECT_EQ(Vec3<double>(last[0], last[1], last[2]), mesh[f].normal());
  }
}

}  // namespace
}  // namespace minkray::testing
