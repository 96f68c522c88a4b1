// SPDX-License-Identifier: MIT
// No signed distance takes longer than its budget of support points: a gap that cannot be closed
// within it is reported, with bounds that hold. Two points known by their support mapping only, at
// one place, took 300,000 of them, since there was no size that a gap could be relative to.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/pair_judge.h"

namespace minkray {
namespace {

using testing::RandomShapes;

/// Known by its support mapping only.
Shape hull_of(const Shape& shape) {
  ShapeList shapes;
  shapes.push_back(shape);
  shapes.push_back(shape);
  return HullOf{shapes};
}

/// Support points used outside of branch and bound: searches before it, and the points of contact
/// after it.
constexpr int beside_each = 1500;

TEST(SupportBudget, directions_that_are_all_as_good_end_with_bounds_that_hold) {
  // The middle of a ball: no number of support points is enough.
  const ContactShape ball(hull_of(Sphere{1})), point(Point{{0, 0, 0}});
  double before = std::numeric_limits<double>::infinity();
  for (const int budget : {100, 1000, 10000, 50000}) {
    SignedDistanceOptions options;
    options.max_supports = budget;
    const SignedDistance found = signed_distance(ball, {}, point, {}, options);
    EXPECT_LE(found.lower, -1) << budget;
    EXPECT_GE(found.upper, -1) << budget;
    EXPECT_NEAR(found.lower, -1, 1e-14) << budget;
    EXPECT_TRUE(found.is_exhausted) << budget;
    EXPECT_LE(found.supports, budget + beside_each) << budget;
    EXPECT_EQ(found.status == SignedStatus::overlapping, found.upper < 0) << budget;
    // Purpose of a larger budget.
    EXPECT_LT(found.upper - found.lower, before) << budget;
    before = found.upper - found.lower;
  }
  EXPECT_LT(before, 3e-3);
}

TEST(SupportBudget, that_is_not_used_up_is_not_told_to_be) {
  const ContactShape ball(hull_of(Sphere{1})), point(Point{{0, 0, 0}});
  SignedDistanceOptions rough;
  rough.tolerance = 1e-2;
  const SignedDistance found = signed_distance(ball, {}, point, {}, rough);
  EXPECT_FALSE(found.is_exhausted);
  EXPECT_LE(found.upper - found.lower, 1e-2 * ball.ball_radius() + 1e-14);
  EXPECT_LT(found.supports, rough.max_supports / 2);
}

TEST(SupportBudget, bounds_hold_for_any_pair_and_any_budget) {
  RandomShapes random(61);
  int exhausted = 0, closed = 0;
  for (int k = 0; k < 600; ++k) {
    // Hidden behind a hull, so that branch and bound has more of them to settle.
    const testing::Body a(hull_of(testing::random_shape(k % 17, 1, random)),
                          {random.turn(), Vec3<double>::Zero()}),
        b(hull_of(testing::random_shape(k / 17 % 17, 1, random)),
          {random.turn(), (k % 2 == 0 ? 0 : random.in(0, 0.2)) * random.direction()});
    SignedDistanceOptions options;
    options.max_supports = 1 + static_cast<int>(std::pow(10, random.in(0, 2)));
    const SignedDistance found = signed_distance(a, b, options);
    const double size = testing::size_of(a, b);
    ASSERT_LE(found.supports, options.max_supports + beside_each) << k;
    ASSERT_LE(found.lower, testing::gap(a, b, found.normal) + 1e-14) << k;
    ASSERT_GE(found.upper, testing::best_gap(a, b, found.normal, random) - 1e-14) << k;
    const double width = found.is_exhausted ? size : 1e-9 * size;
    ASSERT_LE(found.upper - found.lower, 4 * width + 1e-13) << k;
    exhausted += found.is_exhausted;
    closed += !found.is_exhausted;
  }
  EXPECT_GT(exhausted, 50);
  EXPECT_GT(closed, 50);
}

TEST(SupportBudget, points_at_one_place_touch) {
  const ContactShape point(hull_of(hull_of(Point{{-0.0625, -0.0625, -0.0625}})));
  const SignedDistance found = signed_distance(point, {}, point, {});
  EXPECT_EQ(found.status, SignedStatus::touching);
  EXPECT_EQ(found.value, 0);
  EXPECT_LT(found.supports, 100);
  EXPECT_FALSE(found.is_exhausted);
}

}  // namespace
}  // namespace minkray
