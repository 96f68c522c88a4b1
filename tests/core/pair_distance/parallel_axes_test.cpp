// SPDX-License-Identifier: MIT
// Bodies of revolution about one axis, or parallel ones, one in the other: around the axis all
// directions are as good as each other. A ball at the middle of an ellipsoid of revolution took a
// million support points and 2.4 s, and its bounds were still 3.5e-10 of the size apart.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::Body;
using testing::random_shape;
using testing::RandomShapes;

/// The z axis is that of revolution, or another, of a ball that is stretched across it.
Shape of_revolution(int kind, RandomShapes& random) {
  constexpr int kinds[] = {0, 3, 6, 7, 8, 9, 10, 14, 15};
  constexpr int count = std::size(kinds);
  if (kind % (count + 2) < count) return random_shape(kinds[kind % (count + 2)], 1, random);
  const double across = random.in(0.2, 1), along = random.in(0.2, 1);
  if (kind % (count + 2) == count) return Ellipsoid{{across, across, along}};
  return Transform{
      Nested(Shape(Sphere{1})),
      Affine<double>{Vec3<double>(across, across, along).asDiagonal(), Vec3<double>::Zero()}};
}

TEST(ParallelAxes, bodies_of_revolution_take_no_more_support_points_than_others) {
  RandomShapes random(41);
  int overlapping = 0, all = 0;
  for (int k = 0; k < 3000; ++k) {
    const Mat3<double> turn = random.turn();
    // On one axis, next to it by anything from rounding on, or clearly off it.
    double beside = 0;
    if (k % 3 == 1) beside = std::pow(10, random.in(-17, -3));
    if (k % 3 == 2) beside = random.in(0, 1);
    const bool is_upside_down = k % 2 == 1;
    const Mat3<double> flip =
        Vec3<double>(1, is_upside_down ? -1 : 1, is_upside_down ? -1 : 1).asDiagonal();
    const Vec3<double> along(random.in(0, 6) < 1 ? 0 : random.in(-0.5, 0.5), 0, 0);
    const Body a(of_revolution(k, random), {turn, Vec3<double>::Zero()});
    const Body b(of_revolution(k / 11, random),
                 {turn * flip, turn * Vec3<double>(beside, 0, along.x())});
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, random), "") << k;
    ASSERT_FALSE(found.is_exhausted) << k;
    ASSERT_LT(found.supports, 1000) << k;
    overlapping += found.status == SignedStatus::overlapping;
    ++all;
  }
  EXPECT_GT(overlapping, all / 2);
}

TEST(ParallelAxes, a_peg_in_its_hole_leaves_by_the_shorter_way) {
  const ContactShape peg(Shape(Cylinder{0.25, 2})), block(Shape(Cylinder{1, 3}));
  const SignedDistance aside = signed_distance(block, {}, peg, {});
  EXPECT_NEAR(aside.value, -1.25, 1e-14);
  EXPECT_LE(aside.upper - aside.lower, 1e-9);
  EXPECT_NEAR(aside.normal.z(), 0, 1e-12);
  const Affine<double> nearly_out{shifted_by(0, 0, 4.5)};
  const SignedDistance along = signed_distance(block, {}, peg, nearly_out);
  EXPECT_NEAR(along.value, -0.5, 1e-14);
  EXPECT_NEAR(along.normal.z(), 1, 1e-12);
}

TEST(ParallelAxes, that_are_not_quite_are_within_bounds_as_far_apart_as_that) {
  RandomShapes random(43);
  for (int k = 0; k < 60; ++k) {
    const double tilt = std::pow(10, random.in(-9, -7));
    const Body a(Cylinder{random.in(0.2, 1), random.in(0.5, 1)}, {}),
        b(Cone{random.in(0.2, 1), random.in(0.5, 1)},
          {rotation_matrix(tilt, 0.0, 0.0, 1.0), Vec3<double>::Zero()});
    SignedDistanceOptions options;
    options.max_supports = 2000;
    const SignedDistance found = signed_distance(a, b, options);
    ASSERT_LE(found.lower, testing::gap(a, b, found.normal) + 1e-14) << k;
    ASSERT_GE(found.upper, testing::best_gap(a, b, found.normal, random)) << k;
    ASSERT_LE(found.upper - found.lower, 20 * tilt) << k;
  }
}

}  // namespace
}  // namespace minkray
