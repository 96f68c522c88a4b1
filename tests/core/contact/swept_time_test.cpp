// SPDX-License-Identifier: MIT
// When two bodies first touch of which one moves without turning: contacts at the start, and times
// and speeds near the ends of the numbers' range.
#include "core/contact/swept_time.h"

#include <gtest/gtest.h>

#include "core/contact/contact_shape.h"
#include "core/contact/swept_closed.h"

namespace minkray {
namespace {

/// The first stands at the origin, the second is moved and not turned.
struct TwoBodies {
  ContactShape a, b;
  Affine<double> pose_a, pose_b;

  TwoBodies(const Shape<double>& first, const Shape<double>& second, const Vec3<double>& place)
      : a(first), b(second), pose_b{Mat3<double>::Identity(), place} {}
  CorePair pair() const { return pair_of(a, pose_a, pose_a.linear, b, pose_b); }
};

SweptTime swept(const Shape<double>& a, const Shape<double>& b, const Vec3<double>& place,
                const Vec3<double>& velocity, double near, double t_max = 10) {
  const TwoBodies two(a, b, place);
  return swept_time(two.pair(), velocity, t_max, near, nullptr);
}

struct Bodies {
  Shape<double> ball = Sphere<double>{1}, capsule = Capsule<double>{1, 1},
                cylinder = Cylinder<double>{1, 1};
};

TEST(SweptTime, of_what_touches_at_the_start_closed_forms_do_not_tell) {
  const auto [ball, capsule, cylinder] = Bodies();
  // In each other, and less apart than what is near enough.
  for (const double apart : {-0.5, 1e-10}) {
    const Vec3<double> place{2 + apart, 0.25, 0}, velocity{-1, 0, 0};
    EXPECT_EQ(swept(ball, ball, place, velocity, 0.25).status, SweptStatus::open) << apart;
    for (const auto& [a, b] : {std::pair{capsule, capsule}, {ball, cylinder}}) {
      const TwoBodies two(a, b, place);
      ASSERT_TRUE(has_swept_closed(two.pair()));
      EXPECT_EQ(swept_closed(two.pair(), velocity, 10, 0.25).status, SweptStatus::open) << apart;
    }
  }
}

TEST(SweptTime, of_two_balls_is_a_hit_only_where_its_bounds_are_near_enough) {
  const Shape<double> ball = Bodies().ball;
  const SweptTime known = swept(ball, ball, {4, 1, 0}, {-1, 0, 0}, 1e-12);
  ASSERT_EQ(known.status, SweptStatus::hit);
  EXPECT_LE(known.t_hi - known.t_lo, 1e-12);
  EXPECT_NEAR(known.t_lo, 4 - std::sqrt(3), 1e-13);
  EXPECT_NE(swept(ball, ball, {4, 1, 0}, {-1, 0, 0}, 1e-18).status, SweptStatus::hit);
}

TEST(SweptTime, of_speeds_that_are_no_numbers_is_not_known) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  const Shape<double> ball = Bodies().ball;
  for (const Vec3<double>& velocity :
       {Vec3<double>(-infinity, 0, 0), Vec3<double>(-1e300, infinity, 0), Vec3<double>(nan, 0, 0),
        Vec3<double>(0, 0, 0)}) {
    const SweptTime found = swept(ball, ball, {4, 0, 0}, velocity, 1e-9);
    EXPECT_EQ(found.status, SweptStatus::open) << velocity.transpose();
    EXPECT_EQ(found.t_lo, -infinity);
    EXPECT_EQ(found.t_hi, infinity);
  }
}

TEST(SweptTime, that_is_no_number_lies_between_two_of_them) {
  // Exactly 0.75 times the least number: (0.75 * 2^-54) / 2^1020.
  const double unit = 0x1p-54;
  const Shape<double> small = Sphere<double>{unit / 2};
  const SweptTime found =
      swept(small, small, {1.75 * unit, 0, 0}, {-0x1p1020, 0, 0}, 1e-9 * unit, 1);
  ASSERT_EQ(found.status, SweptStatus::hit);
  EXPECT_EQ(found.t_lo, 0);
  EXPECT_GE(found.t_hi, std::numeric_limits<double>::denorm_min());
}

}  // namespace
}  // namespace minkray
