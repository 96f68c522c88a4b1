// SPDX-License-Identifier: MIT
// Bodies as people place them: upright, on a grid, turned by right angles, with sizes that are
// multiples of one length. Faces lie in one plane, axes are parallel, corners lie on axes, and many
// directions are as good as each other.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/aligned_bodies.h"
#include "tests/core/pair_distance/pair_judge.h"

namespace minkray {
namespace {

using testing::aligned_shape;
using testing::Body;
using testing::grid_point;
using testing::RandomShapes;
using testing::right_angle;

TEST(AlignedPairs, are_settled_but_for_corners_on_axes_and_those_say_so) {
  RandomShapes random(5), judge(6);
  int exhausted = 0, overlapping = 0, all = 0;
  for (int k = 0; k < 6000; ++k, ++all) {
    const Shape one = aligned_shape(k, random), other = aligned_shape(k / 9, random);
    const Mat3<double> turn_a = right_angle(random), turn_b = right_angle(random);
    const Body a(one, {turn_a, Vec3<double>::Zero()}), b(other, {turn_b, grid_point(random)});
    SignedDistanceOptions options;
    options.max_supports = 10000;
    const SignedDistance found = signed_distance(a, b, options);
    overlapping += found.status == SignedStatus::overlapping;
    if (!found.is_exhausted) {
      ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
      continue;
    }
    ++exhausted;
    const double size = testing::size_of(a, b);
    ASSERT_LE(found.lower, testing::gap(a, b, found.normal) + 1e-14 * size) << k;
    ASSERT_GE(found.upper, testing::best_gap(a, b, found.normal, judge) - 1e-14 * size) << k;
    ASSERT_LE(found.upper - found.lower, 1e-3 * size) << k;
  }
  EXPECT_GT(overlapping, all / 3);
  EXPECT_LT(exhausted, all / 100);
}

}  // namespace
}  // namespace minkray
