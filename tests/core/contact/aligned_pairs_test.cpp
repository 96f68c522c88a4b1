// SPDX-License-Identifier: MIT
// Bodies as people place them: upright, on a grid, turned by right angles, with sizes that are
// multiples of one length. Faces lie in one plane, axes are parallel, corners lie on axes, and many
// directions are as good as each other.
#include <gtest/gtest.h>

#include "tests/core/contact/pair_judge.h"

namespace minkray {
namespace {

using testing::Body;
using testing::RandomShapes;

constexpr double unit_length = 0.25;

double on_grid(RandomShapes& random) {
  return unit_length * std::floor(random.in(-4, 5));
}

Vec3<double> grid_point(RandomShapes& random) {
  const double x = on_grid(random), y = on_grid(random), z = on_grid(random);
  return {x, y, z};
}

Shape<double> aligned_shape(int kind, RandomShapes& random) {
  const auto size = [&] { return unit_length * std::floor(random.in(1, 5)); };
  const double x = size(), y = size(), z = size(), radius = size();
  switch (kind % 9) {
    case 0:
      return Box<double>{{x, y, z}};
    case 1:
      return Cylinder<double>{x, y};
    case 2:
      return Cone<double>{x, y};
    case 3:
      return Sphere<double>{x};
    case 4:
      return Capsule<double>{x, y};
    case 5:
      return Ellipsoid<double>{{x, y, z}};
    case 6:
      return Frustum<double>{{x, y}, z};
    case 7:
      return Rounded<double>{radius, Nested<double>(Shape<double>(Box<double>{{x, y, z}}))};
    default: {
      std::vector<Vec3<double>> points;
      for (int i = 0; i < 10; ++i) points.push_back(grid_point(random));
      return Hull<double>{PointCloud<double>(points)};
    }
  }
}

Mat3<double> right_angle(RandomShapes& random) {
  const double half = std::sqrt(0.5);
  switch (static_cast<int>(random.in(0, 6))) {
    case 0:
      return rotation_matrix(half, 0.0, 0.0, half);
    case 1:
      return rotation_matrix(0.0, half, 0.0, half);
    case 2:
      return rotation_matrix(0.0, 0.0, half, half + 1);
    default:
      return Mat3<double>::Identity();
  }
}

TEST(AlignedPairs, are_settled_but_for_corners_on_axes_and_those_say_so) {
  RandomShapes random(5), judge(6);
  int exhausted = 0, overlapping = 0, all = 0;
  for (int k = 0; k < 6000; ++k, ++all) {
    const Shape<double> one = aligned_shape(k, random), other = aligned_shape(k / 9, random);
    const Mat3<double> turn_a = right_angle(random), turn_b = right_angle(random);
    const Body a(one, {turn_a, Vec3<double>::Zero()}), b(other, {turn_b, grid_point(random)});
    SignedDistanceOptions options;
    options.max_supports = 10000;
    const SignedDistance found = signed_distance(a.ready, a.pose, b.ready, b.pose, options);
    overlapping += found.status == SignedStatus::overlapping;
    if (!found.is_exhausted) {
      ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
      continue;
    }
    ++exhausted;
    const double size = a.ready.ball_radius() + b.ready.ball_radius();
    ASSERT_LE(found.lower, testing::gap(a, b, found.normal) + 1e-14 * size) << k;
    ASSERT_GE(found.upper, testing::best_gap(a, b, found.normal, judge) - 1e-14 * size) << k;
    ASSERT_LE(found.upper - found.lower, 1e-3 * size) << k;
  }
  EXPECT_GT(overlapping, all / 3);
  EXPECT_LT(exhausted, all / 100);
}

}  // namespace
}  // namespace minkray
