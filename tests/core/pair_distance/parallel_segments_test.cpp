// SPDX-License-Identifier: MIT
// Segments and capsules that are parallel, or nearly so, next to or in one another. The normal
// came of a cross product that was nothing but rounding: capsules on one line had a normal along
// it, as deep as their lengths instead of their radii. Every fifth of the pairs here was wrong.
#include <gtest/gtest.h>

#include "core/pair/closed_pairs.h"
#include "tests/core/pair_distance/pair_judge.h"

namespace minkray {
namespace {

using testing::Body;
using testing::RandomShapes;

TEST(ParallelSegments, nearly_so_have_planes_and_points_that_hold) {
  RandomShapes random(5), judge(6);
  int overlapping = 0, all = 0;
  for (int k = 0; k < 60000; ++k) {
    const Mat3<double> turn = random.turn();
    const auto little = [&] {
      return random.in(0, 1) < 0.3 ? 0.0 : std::pow(10, random.in(-17, -1));
    };
    const bool is_grown = k % 2 == 0;
    const auto shape = [&](double scale) -> Shape {
      const Vec3<double> half(0, 0, scale * random.in(0.1, 1));
      const Shape segment = Segment{{-half, half}};
      if (!is_grown) return segment;
      return Rounded{random.in(0, 0.5), Nested(segment)};
    };
    const Body a(shape(k % 7 == 0 ? std::pow(10, random.in(-3, 3)) : 1),
                 {turn, Vec3<double>::Zero()});
    const double x = little(), y = little(), along = k % 3 == 0 ? 0 : random.in(-2, 2),
                 tilt_x = little(), tilt_y = little();
    const Body b(shape(1), {turn * rotation_matrix(tilt_x, tilt_y, 0.0, 1.0),
                            turn * Vec3<double>(x, y, along)});
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
    overlapping += found.status == SignedStatus::overlapping;
    ++all;
  }
  EXPECT_GT(overlapping, all / 4);
  EXPECT_LT(overlapping, all * 3 / 4);
}

/// If two lean by some dozens of roundings of a direction, their ends are already further apart
/// than the rounding of lengths.
TEST(ParallelSegments, that_cross_in_their_middle_touch_however_little_they_lean) {
  RandomShapes random(3);
  constexpr double epsilon = tolerance::epsilon<double>;
  for (int k = 0; k < 100; ++k) {
    const Affine<double> pose{random.turn(), Vec3<double>::Zero()};
    const Vec3<double> p(0, 0, 1), q(random.in(56, 64) * epsilon, 0, 1);
    const SignedDistance found =
        signed_distance(ContactShape(Segment{{-p, p}}), pose, ContactShape(Segment{{-q, q}}), pose);
    EXPECT_EQ(found.status, SignedStatus::touching);
    EXPECT_NEAR(found.value, 0, 16 * epsilon * (p.norm() + q.norm())) << k;
  }
}

/// An end of one is next to the other, across both: the way between them is short of digits if
/// they lean by little.
TEST(ParallelSegments, that_lean_by_little_have_bounds_of_a_few_roundings) {
  // Bounds were up to 1.5e-15 of the sizes apart, and 4e-10 without the plane across both.
  constexpr double few_roundings = 1e-14;
  RandomShapes random(7);
  for (int k = 0; k < 200000; ++k) {
    const auto vector = [&]() -> Vec3<double> { return random.turn().col(0) * random.in(0.1, 1); };
    const Vec3<double> p = vector(), lean = vector();
    const Vec3<double> q = random.in(-2, 2) * p + std::pow(10, random.in(-16, -2)) * lean;
    const Vec3<double> across = (k % 5 < 2 ? -1 : 1) * unit<double>(p.cross(lean)),
                       aside = k % 3 == 0 ? vector() : across;
    const double along = random.in(-1, 1), end = k % 2 == 0 ? -1 : 1;
    const double s = k % 4 < 2 ? along : end, t = k % 4 < 2 ? end : along;
    const Vec3<double> x = s * p - t * q + std::pow(10, random.in(-16, 0)) * aside;
    const CoreDistance found = between_segments(p, q, x);
    ASSERT_LE(found.upper - found.lower, few_roundings * (p.norm() + q.norm())) << k;
  }
}

/// An end of one is next to the other, or to its end, at up to 0.8e-10 of the lengths. The way from
/// one to the other, rounded, is no direction for a plane then: the best plane is at right angles
/// to both, and others were up to 5e-4 of the sizes nearer than that.
TEST(ParallelSegments, that_nearly_touch_at_an_end_have_planes_and_points_that_hold) {
  RandomShapes random(15), judge(16);
  const auto segment = [](double half) -> Shape {
    return Segment{{Vec3<double>(0, 0, -half), Vec3<double>(0, 0, half)}};
  };
  for (int k = 0; k < 4000; ++k) {
    const auto near_end = [&] {
      const double end = random.in(0, 1) < 0.5 ? 1 : -1;
      return random.in(0, 1) < 0.5 ? end
                                   : end + random.in(-1, 1) * std::pow(10, random.in(-16, -1));
    };
    const Mat3<double> turn = random.turn(),
                       lean = rotation_matrix(std::pow(10, random.in(-16, -1)), 0.0, 0.0, 1.0);
    const double half_a = random.in(0.1, 1), half_b = random.in(0.1, 1), s = half_a * near_end(),
                 t = half_b * (k % 3 > 0 ? near_end() : random.in(-1, 1)),
                 apart = std::pow(10, k % 2 > 0 ? random.in(-20, -1) : random.in(-10.4, -10.1)),
                 angle = k % 4 < 2 ? 0 : random.in(-3, 3);
    const Vec3<double> aside =
        std::hypot(half_a, half_b) * apart * Vec3<double>(std::cos(angle), std::sin(angle), 0);
    const Body a(segment(half_a), {turn, Vec3<double>::Zero()}),
        b(segment(half_b),
          {turn * lean, turn * (aside + Vec3<double>(0, 0, s) - lean * Vec3<double>(0, 0, t))});
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
  }
}

TEST(ParallelSegments, capsules_on_one_line_leave_it_sideways) {
  const ContactShape capsule(Shape(Capsule{0.25, 1}));
  const Mat3<double> turn = rotation_matrix(0.3, -0.2, 0.7, 0.6);
  const Affine<double> one{turn, {0, 0, 0}}, two{turn, turn * Vec3<double>(0, 0, 0.125)};
  const SignedDistance found = signed_distance(capsule, one, capsule, two);
  EXPECT_NEAR(found.value, -0.5, 1e-14);
  EXPECT_NEAR(found.normal.dot(turn.col(2)), 0, 1e-14);
}

}  // namespace
}  // namespace minkray
