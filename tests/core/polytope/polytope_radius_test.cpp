// SPDX-License-Identifier: MIT
// A polytope's radius holds all of its points, and one without a radius has no closed form.
#include <gtest/gtest.h>

#include <random>

#include "core/geometry/point_cloud.h"
#include "core/polytope/polytope.h"

namespace minkray::exact {
namespace {

TEST(PolytopeRadius, holds_every_point_however_norms_are_rounded) {
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3<double>> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(any(random), any(random), any(random));
    const PointCloud cloud(points);
    const auto polytope = Polytope::of(cloud, Vec3<double>(0, 0, 0), 1, 0);
    if (!polytope) continue;
    long double furthest = 0;
    for (const Vec3<double>& point : cloud.points())
      furthest = std::max(furthest, Vec3<long double>(point.cast<long double>()).norm());
    EXPECT_GE(static_cast<long double>(polytope->radius()), furthest);
    EXPECT_LE(static_cast<long double>(polytope->radius()), furthest * 1.00001L);
  }
}

TEST(PolytopeRadius, that_is_no_number_leaves_no_polytope) {
  std::vector<Vec3<double>> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) points.emplace_back(x, y, z);
  const PointCloud cloud(points);
  EXPECT_TRUE(Polytope::of(cloud, Vec3<double>(0, 0, 0), 1e100, 0));
  EXPECT_FALSE(Polytope::of(cloud, Vec3<double>(0, 0, 0), 1e200, 0));
}

}  // namespace
}  // namespace minkray::exact
