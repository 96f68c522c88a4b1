// SPDX-License-Identifier: MIT
// First contact of two bodies where one moves without turning: contacts at the start, and times
// and speeds near the ends of the numbers' range.
#include "core/pair_motion/swept_time.h"

#include <gtest/gtest.h>

#include "core/pair/contact_shape.h"
#include "core/pair_motion/swept_closed.h"
#include "tests/core/pair_distance/random_bodies.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::RandomShapes;

/// The first is at the origin, the second is moved and not turned.
struct TwoBodies {
  ContactShape a, b;
  Affine<double> pose_a, pose_b;

  TwoBodies(const Shape& first, const Shape& second, const Vec3<double>& place)
      : a(first), b(second), pose_b{shifted_by(place)} {}
  CorePair pair() const { return pair_of(a, pose_a, pose_a.linear, b, pose_b); }
};

SweptTime swept(const Shape& a, const Shape& b, const Vec3<double>& place,
                const Vec3<double>& velocity, double near, double t_max = 10) {
  const TwoBodies two(a, b, place);
  return swept_time(two.pair(), velocity, t_max, near, nullptr);
}

struct Bodies {
  Shape ball = Sphere{1}, capsule = Capsule{1, 1}, cylinder = Cylinder{1, 1};
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
  const Shape ball = Bodies().ball;
  const SweptTime known = swept(ball, ball, {4, 1, 0}, {-1, 0, 0}, 1e-12);
  ASSERT_EQ(known.status, SweptStatus::hit);
  EXPECT_LE(known.t_hi - known.t_lo, 1e-12);
  EXPECT_NEAR(known.t_lo, 4 - std::sqrt(3), 1e-13);
  EXPECT_NE(swept(ball, ball, {4, 1, 0}, {-1, 0, 0}, 1e-18).status, SweptStatus::hit);
}

TEST(SweptTime, of_balls_that_would_meet_later_has_the_axis_of_the_end_of_time) {
  const Shape ball = Bodies().ball;
  const SweptTime early = swept(ball, ball, {4, 1, 0}, {-1, 0, 0}, 1e-12, 1.5);
  ASSERT_EQ(early.status, SweptStatus::miss);
  EXPECT_LT((early.axis - Vec3<double>(2.5, 1, 0).normalized()).norm(), 1e-15);
}

TEST(SweptTime, of_speeds_that_are_no_numbers_is_not_known) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  const Shape ball = Bodies().ball;
  for (const Vec3<double>& velocity :
       {Vec3<double>(-infinity, 0, 0), Vec3<double>(infinity, 0, 0),
        Vec3<double>(-1e300, infinity, 0), Vec3<double>(nan, 0, 0), Vec3<double>(0, 0, 0)}) {
    const SweptTime found = swept(ball, ball, {4, 0, 0}, velocity, 1e-9);
    EXPECT_EQ(found.status, SweptStatus::open) << velocity.transpose();
    EXPECT_EQ(found.t_lo, -infinity);
    EXPECT_EQ(found.t_hi, infinity);
  }
}

TEST(SweptTime, that_is_no_number_lies_between_two_of_them) {
  // Exactly 0.75 times the least number: (0.75 * 2^-54) / 2^1020.
  const double unit = 0x1p-54;
  const Shape small = Sphere{unit / 2};
  const SweptTime found =
      swept(small, small, {1.75 * unit, 0, 0}, {-0x1p1020, 0, 0}, 1e-9 * unit, 1);
  ASSERT_EQ(found.status, SweptStatus::hit);
  EXPECT_EQ(found.t_lo, 0);
  EXPECT_GE(found.t_hi, std::numeric_limits<double>::denorm_min());
}

/// Newton's steps end where rounding leaves nothing of the gap: from 100 sizes away that is 1e-13.
TEST(SweptTime, of_closed_forms_is_told_as_exactly_as_rounding_allows) {
  RandomShapes random(33);
  for (int k = 0; k < 300; ++k) {
    const Vec3<double> place = 100 * random.direction();
    const TwoBodies two(
        k % 3 == 0 ? testing::random_shape(9, 1, random) : Shape(Sphere{random.in(0.3, 1)}),
        testing::random_shape(k % 3 == 1 ? 5 : 9, 1, random), place);
    ASSERT_TRUE(has_swept_closed(two.pair()));
    const Vec3<double> velocity = 0.1 * random.direction() - 0.9 * place;
    const SweptTime found = swept_closed(two.pair(), velocity, 2, 1e-11);
    ASSERT_EQ(found.status, SweptStatus::hit) << k;
    EXPECT_LE((found.t_hi - found.t_lo) * velocity.norm(), 1e-11) << k;
  }
}

/// Four points of a hull lead, as the way of the point goes through their shadows:
///
///                     . C       A leads, B and C are as far, D is behind them. The way goes by
///               .  .    A       `beside` on D's side of the line from B to C.
///       D   o   .
///        .   .
///     B
TEST(SweptTime, of_a_way_right_beside_an_edge_of_the_shadow_is_told) {
  const Shape point = Point{},
              hull = Hull{PointCloud(std::vector<Vec3<double>>{
                  {0, 3, 1}, {1, -3, -2}, {1, 2.25, 1.5}, {2, -2, -0.75}, {9, 0, 0.25}})};
  const Vec3<double> aside = Vec3<double>(0, 2, -3).normalized();
  for (const double beside : {1e-14, 1.5e-14, 2e-14, 1e-9, 0.1}) {
    const SweptTime found =
        swept(point, hull, Vec3<double>(9, 0, 0) + beside * aside, {-1, 0, 0}, 1e-9, 20);
    ASSERT_EQ(found.status, SweptStatus::hit) << beside;
    EXPECT_NEAR(found.t_lo, 10 + beside * std::sqrt(13) / 1.75, 1e-12) << beside;
    EXPECT_NEAR(found.t_hi, found.t_lo, 1e-12) << beside;
  }
}

/// Each new support point of the shadow is a new corner of it, or the search ends.
TEST(SweptTime, of_a_way_next_to_the_other_body_is_given_up_by_the_time_all_corners_are_seen) {
  const Shape point = Point{};
  RandomShapes random(34);
  int open = 0;
  for (int k = 0; k < 300; ++k) {
    const Shape hull = random.hull(8, 1);
    // The point furthest aside passes the other by half of the tolerance.
    const Vec3<double> aside = Vec3<double>(0, random.in(-1, 1), random.in(-1, 1)).normalized();
    Vec3<double> place = -hull.support(aside) - 0.005 * aside;
    place.x() = 9;
    const SweptTime found = swept(point, hull, place, {-1, 0, 0}, 0.01, 20);
    open += found.status == SweptStatus::open;
    EXPECT_NE(found.status, SweptStatus::hit) << k;
    EXPECT_LE(found.supports, 9) << k;
  }
  EXPECT_GT(open, 200);
}

/// At 1e200 sizes nothing is known of any plane.
TEST(SweptTime, that_nothing_is_known_of_leaves_the_memory_as_it_is) {
  const auto [ball, capsule, cylinder] = Bodies();
  for (const auto& [a, b] : {std::pair{capsule, cylinder}, {cylinder, cylinder}}) {
    const TwoBodies two(a, b, {1e200, 0, 0});
    PairMemory memory;
    memory.axis = Vec3<double>(0.6, 0.8, 0);
    EXPECT_EQ(swept_time(two.pair(), {-1, 0, 0}, 10, 1e-9, &memory).status, SweptStatus::open);
    EXPECT_EQ(memory.axis, Vec3<double>(0.6, 0.8, 0));
  }
}

/// Beyond them sixth powers of an ellipsoid's lengths were infinite, and it was passed by.
TEST(SweptTime, of_any_size_is_the_same_or_not_told) {
  RandomShapes random(35);
  const Shape ellipsoid = Ellipsoid{{1, 0.75, 0.5}};
  for (const int power : {-500, -300, -165, -158, 0, 158, 165, 175, 300, 500}) {
    const double scale = std::ldexp(1.0, power);
    const Shape scaled = Ellipsoid{{scale, 0.75 * scale, 0.5 * scale}};
    for (int k = 0; k < 20; ++k) {
      const Vec3<double> place = 4 * random.direction(),
                         velocity = 0.5 * random.direction() - place;
      const SweptTime of_one = swept(ellipsoid, ellipsoid, place, velocity, 1e-9),
                      found = swept(scaled, scaled, scale * place, scale * velocity, 1e-9 * scale);
      EXPECT_EQ(found.status, std::abs(power) > 158 ? SweptStatus::open : of_one.status) << power;
      if (found.status != SweptStatus::hit) continue;
      EXPECT_NEAR(found.t_lo, of_one.t_lo, 1e-9) << power;
    }
  }
}

}  // namespace
}  // namespace minkray
