// SPDX-License-Identifier: MIT
// Bounds along a half meridian, of bodies of revolution with one axis whose distance is known.
#include "core/pair_distance/meridian_bounds.h"

#include <gtest/gtest.h>

#include "core/pair/contact_shape.h"

namespace minkray {
namespace {

std::optional<CoreDistance> bounded(const Shape& a, const Shape& b, const Vec3<double>& place,
                                    double tilt = 0) {
  const ContactShape ready_a{a}, ready_b{b};
  const Affine<double> pose_a,
      pose_b{Eigen::AngleAxis<double>(tilt, Vec3<double>::UnitX()).toRotationMatrix(), place};
  return bound_along_meridian(pair_of(ready_a, pose_a, pose_a.linear, ready_b, pose_b), {}, 1e-10);
}

TEST(MeridianBounds, are_around_distances_and_depths_and_as_near_as_asked) {
  const Shape cylinder = Cylinder{1, 1}, point = Point{{0, 0, 0}}, ellipsoid = Ellipsoid{{1, 1, 2}};
  struct {
    const Shape &a, &b;
    Vec3<double> place;
    double distance;
  } const known[] = {{cylinder, cylinder, {0, 0, 1.5}, -0.5},
                     {cylinder, cylinder, {0, 0, 3}, 1},
                     {cylinder, cylinder, {1.5, 0, 0}, -0.5},
                     {cylinder, cylinder, {3, 0, 3.5}, std::hypot(1, 1.5)},
                     {cylinder, cylinder, {0, 2.25, 4}, std::hypot(0.25, 2)},
                     {cylinder, point, {0, 2, 2.5}, std::hypot(1, 1.5)},
                     {point, cylinder, {0, 2, -2.5}, std::hypot(1, 1.5)},
                     {ellipsoid, ellipsoid, {0, 0, 3.5}, -0.5},
                     {ellipsoid, ellipsoid, {2.5, 0, 0}, 0.5}};
  int k = 0;
  for (const auto& [a, b, place, distance] : known) {
    const std::optional<CoreDistance> found = bounded(a, b, place);
    ASSERT_TRUE(found) << k;
    EXPECT_LE(found->lower, distance + 1e-14) << k;
    EXPECT_GE(found->upper, distance - 1e-14) << k;
    EXPECT_LE(found->upper - found->lower, 1e-9) << k;
    EXPECT_EQ(found->status, distance > 0 ? CoreStatus::separated : CoreStatus::overlapping) << k;
    EXPECT_FALSE(found->is_exhausted) << k;
    ++k;
  }
}

TEST(MeridianBounds, of_axes_that_lean_by_a_millionth_are_apart_by_what_that_moves) {
  const Shape cylinder = Cylinder{1, 1};
  for (const double tilt : {1e-13, 3e-9, -3e-7, 3e-6, -0.1}) {
    const std::optional<CoreDistance> found = bounded(cylinder, cylinder, {0, 0, 3}, tilt);
    const double leans = std::abs(tilt);
    ASSERT_EQ(found.has_value(), leans < 1e-6) << tilt;
    if (!found) continue;
    // The rim of the upper one comes so near to the disk that is the lower one's top.
    const double distance = 2 - std::cos(leans) - std::sin(leans);
    EXPECT_LE(found->lower, distance + 1e-14) << tilt;
    EXPECT_GE(found->upper, distance - 1e-14) << tilt;
    EXPECT_LE(found->upper - found->lower, 12 * leans + 1e-9) << tilt;
    EXPECT_EQ(found->is_exhausted, leans > 1e-10) << tilt;
  }
}

TEST(MeridianBounds, are_of_bodies_of_revolution_only) {
  EXPECT_FALSE(bounded(Cylinder{1, 1}, Box{{1, 1, 1}}, {0, 0, 3}));
  EXPECT_FALSE(bounded(Ellipsoid{{1, 2, 3}}, Cylinder{1, 1}, {0, 0, 3}));
}

}  // namespace
}  // namespace minkray
