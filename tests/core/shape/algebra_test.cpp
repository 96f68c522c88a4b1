// SPDX-License-Identifier: MIT
// The algebra of shapes, as laws of support functions, for shapes and directions drawn at random.
#include "tests/fuzz/extent.h"
#include "tests/support/property.h"

namespace minkray::testing {
namespace {

using S = Shape;
using P = Vec3<double>;

constexpr int draws = 1500;

/// Supports are rounded relative to the largest number on the way to them; both sides of a law.
double rounding(const S& a, const S& b) {
  constexpr double roundings = 64;
  const auto of = [](const S& shape) {
    const fuzz::Extent extent = fuzz::extent_of(shape);
    return static_cast<double>(extent.size);
  };
  return roundings * std::numeric_limits<double>::epsilon() * (of(a) + of(b));
}

double reach(const S& shape, const P& n) {
  return n.dot(shape.support(n));
}

/// Both reach equally far.
void assert_same(const S& a, const S& b, const P& n) {
  RC_ASSERT(std::abs(reach(a, n) - reach(b, n)) <= rounding(a, b));
}

S moved(const S& shape, const Affine<double>& map) {
  return Transform{shape, AffineMap(map)};
}

TEST(Algebra, a_sum_reaches_as_far_as_its_parts_together) {
  expect_always(
      [] {
        const S a = draw_shape(), b = draw_shape();
        const P n = draw_direction();
        const S sum = MinkowskiSum{{a, b}};
        RC_ASSERT(std::abs(reach(sum, n) - (reach(a, n) + reach(b, n))) <= rounding(a, b));
        RC_ASSERT((sum.support(n) - (a.support(n) + b.support(n))).norm() <= rounding(a, b));
      },
      draws);
}

TEST(Algebra, a_hull_reaches_as_far_as_the_furthest_of_its_parts) {
  expect_always(
      [] {
        const S a = draw_shape(), b = draw_shape(), c = draw_shape(0);
        const P n = draw_direction();
        const S hull = HullOf{{a, b, c}};
        const double furthest = std::max({reach(a, n), reach(b, n), reach(c, n)});
        RC_ASSERT(std::abs(reach(hull, n) - furthest) <= rounding(hull, hull));
      },
      draws);
}

TEST(Algebra, rounding_is_a_sum_with_a_ball) {
  expect_always(
      [] {
        const S a = draw_shape();
        const double radius = *rc::gen::inRange(1, 64) / 16.0;
        assert_same(Rounded{radius, a}, MinkowskiSum{{a, S(Sphere{radius})}}, draw_direction());
      },
      draws);
}

TEST(Algebra, a_difference_is_a_sum_with_the_mirror_image) {
  expect_always(
      [] {
        const S a = draw_shape(), b = draw_shape();
        const S mirrored = moved(b, {-Mat3<double>::Identity(), P(0, 0, 0)});
        assert_same(MinkowskiDifference{a, b}, MinkowskiSum{{a, mirrored}}, draw_direction());
      },
      draws);
}

TEST(Algebra, a_shape_minus_itself_is_symmetric_and_holds_the_origin) {
  expect_always(
      [] {
        const S a = draw_shape();
        const S difference = MinkowskiDifference{a, a};
        const P n = draw_direction();
        RC_ASSERT(std::abs(reach(difference, n) - reach(difference, -n)) <= rounding(a, a));
        RC_ASSERT(reach(difference, n) >= -rounding(a, a));
      },
      draws);
}

TEST(Algebra, sums_and_hulls_do_not_care_for_order_or_brackets) {
  expect_always(
      [] {
        const S a = draw_shape(1), b = draw_shape(1), c = draw_shape(1);
        const P n = draw_direction();
        using Sum = MinkowskiSum;
        using Join = HullOf;
        assert_same(Sum{{a, S(Sum{{b, c}})}}, Sum{{S(Sum{{a, b}}), c}}, n);
        assert_same(Sum{{a, b, c}}, Sum{{c, a, b}}, n);
        assert_same(Join{{a, S(Join{{b, c}})}}, Join{{S(Join{{a, b}}), c}}, n);
        assert_same(Join{{a, b, c}}, Join{{c, a, b}}, n);
      },
      draws);
}

TEST(Algebra, a_sum_with_a_hull_is_the_hull_of_the_sums) {
  expect_always(
      [] {
        const S a = draw_shape(1), b = draw_shape(1), c = draw_shape(1);
        assert_same(MinkowskiSum{{a, S(HullOf{{b, c}})}},
                    HullOf{{S(MinkowskiSum{{a, b}}), S(MinkowskiSum{{a, c}})}}, draw_direction());
      },
      draws);
}

TEST(Algebra, maps_commute_with_sums_and_hulls) {
  expect_always(
      [] {
        const S a = draw_shape(1), b = draw_shape(1);
        const P n = draw_direction(), by = draw_direction();
        const Affine<double> map{draw_rotation() * P(2, 0.5, -1).asDiagonal(), by};
        const Affine<double> linear{map.linear, P(0, 0, 0)};
        assert_same(moved(MinkowskiSum{{a, b}}, map),
                    MinkowskiSum{{moved(a, map), moved(b, linear)}}, n);
        assert_same(moved(HullOf{{a, b}}, map), HullOf{{moved(a, map), moved(b, map)}}, n);
      },
      draws);
}

TEST(Algebra, maps_of_maps_are_one_map) {
  expect_always(
      [] {
        const S a = draw_shape(1);
        const P by = draw_direction(), then = draw_direction(), n = draw_direction();
        const Affine<double> first{draw_rotation() * P(2, 1, 0.25).asDiagonal(), by};
        const Affine<double> second{P(1, -1, 4).asDiagonal() * draw_rotation(), then};
        assert_same(moved(moved(a, first), second), moved(a, second * first), n);
      },
      draws);
}

TEST(Algebra, a_support_point_is_beaten_by_no_other) {
  expect_always(
      [] {
        const S a = draw_shape(3);
        const P n = draw_direction(), m = draw_direction();
        RC_ASSERT(n.dot(a.support(m) - a.support(n)) <= rounding(a, a));
      },
      draws);
}

}  // namespace
}  // namespace minkray::testing
