// SPDX-License-Identifier: MIT
// Signed distances are judged by planes and points of the shapes' own support mappings, which the
// solvers do not use.
#include "core/pair_distance/signed_distance.h"

#include <gtest/gtest.h>

#include "core/pair_distance/half_space_distance.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::Body;
using testing::kinds_of_bodies;
using testing::random_shape;
using testing::RandomShapes;

TEST(SignedDistance, random_pairs_of_all_kinds_are_proven_by_planes_and_points) {
  RandomShapes random(31);
  int separated = 0, overlapping = 0, touching = 0, all = 0;
  for (int i = 0; i < kinds_of_bodies; ++i)
    for (int j = 0; j < kinds_of_bodies; ++j)
      for (int k = 0; k < 24; ++k) {
        const testing::RandomPair pair = testing::random_pair(i, j, k, random);
        const SignedDistance result = signed_distance(pair.a, pair.b);
        const std::string wrong = testing::complaint(pair.a, pair.b, result, random);
        ASSERT_EQ(wrong, "") << "kinds " << i << " and " << j << ", " << k;
        separated += result.status == SignedStatus::separated;
        overlapping += result.status == SignedStatus::overlapping;
        touching += result.status == SignedStatus::touching;
        ++all;
      }
  EXPECT_GT(separated, all / 4);
  EXPECT_GT(overlapping, all / 4);
  EXPECT_GT(touching, all / 100);
}

TEST(SignedDistance, the_order_of_the_two_turns_the_normal_and_nothing_else) {
  RandomShapes random(11);
  for (int k = 0; k < 2000; ++k) {
    const Body a(random_shape(k % kinds_of_bodies, 1, random),
                 {random.turn(), Vec3<double>::Zero()});
    const Body b(random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random),
                 {random.turn(), random.in(0, 3) * random.direction()});
    const SignedDistance one = signed_distance(a, b), two = signed_distance(b, a);
    ASSERT_LE(one.lower, two.upper) << k;
    ASSERT_LE(two.lower, one.upper) << k;
    const double size = testing::size_of(a, b);
    ASSERT_NEAR(one.value, two.value, 1e-9 * size + 1e-14) << k;
  }
}

TEST(SignedDistance, early_answers_agree_with_whole_ones) {
  RandomShapes random(13);
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 2000; ++k) {
    const Body a(random_shape(k % kinds_of_bodies, 1, random),
                 {random.turn(), Vec3<double>::Zero()});
    const Body b(random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random),
                 {random.turn(), random.in(0, 3) * random.direction()});
    const SignedDistance whole = signed_distance(a, b);
    SignedDistanceOptions near;
    near.at_most = 0.3;
    const SignedDistance bounded = signed_distance(a, b, near);
    if (whole.lower > 0.3 + 1e-9) {
      ++apart;
      ASSERT_GT(bounded.lower, 0.3) << k;
    }
    if (whole.upper < 0.3 - 1e-9) {
      ASSERT_NEAR(bounded.value, whole.value, 1e-9) << k;
    }
    ASSERT_LE(bounded.lower, whole.upper) << k;
    ASSERT_GE(bounded.upper, whole.lower) << k;
    SignedDistanceOptions sign;
    sign.only_sign = true;
    const SignedDistance signs = signed_distance(a, b, sign);
    if (std::abs(whole.value) > 1e-9) {
      ASSERT_EQ(signs.status, whole.status) << k;
    }
    overlapping += whole.status == SignedStatus::overlapping;
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(overlapping, 300);
}

/// A search that ends between a plane and a common point has neither: it must continue.
TEST(SignedDistance, the_sign_alone_is_that_of_the_whole_answer_where_bodies_overlap_by_little) {
  RandomShapes random(19);
  constexpr int cone = 8, frustum = 10, hull = 11, tapered_capsule = 15, all = 450;
  int overlapping = 0;
  SignedDistanceOptions sign;
  sign.only_sign = true;
  for (int k = 0; k < all; ++k) {
    const int other = k % 3 == 0 ? frustum : k % 3 == 1 ? hull : tapered_capsule;
    const Mat3<double> turn = random.turn();  // of both: their axes are parallel
    const Body a(random_shape(cone, 1, random), {turn, Vec3<double>::Zero()});
    Body b(random_shape(other, 1, random), {turn, 3 * random.direction()});
    const double size = testing::size_of(a, b);
    testing::bring_near(a, b, -std::pow(10, random.in(-8.5, -4)), size);
    const SignedDistance whole = signed_distance(a, b);
    if (whole.status != SignedStatus::overlapping) continue;
    ++overlapping;
    EXPECT_EQ(signed_distance(a, b, sign).status, SignedStatus::overlapping)
        << k << ": " << whole.value / size;
  }
  EXPECT_GT(overlapping, all * 9 / 10);
}

/// The others are known by their support mappings only, so that the search comes as near as it
/// must and no nearer.
TEST(SignedDistance, bounds_are_as_near_to_each_other_as_is_asked) {
  RandomShapes random(8);
  int all = 0, nearer = 0;
  for (const double asked : {1e-13, 1e-14})
    for (const int kind : {15, 16})
      for (int k = 0; k < 40; ++k, ++all) {
        const Body ball(Sphere{random.in(0.2, 1)}, {}),
            other(random_shape(kind, 1, random), {random.turn(), 5 * random.direction()});
        SignedDistanceOptions options;
        options.tolerance = asked;
        const SignedDistance found = signed_distance(ball, other, options);
        ASSERT_EQ(found.status, SignedStatus::separated);
        const double size = testing::size_of(ball, other),
                     middles = middle_in_world(other.ready, other.pose).norm();
        const double rounding =
            16 * tolerance::epsilon<double> * (size + middles) + other.ready.core().rounding;
        nearer += found.upper - found.lower <= 1.01 * asked * size + 2 * rounding;
      }
  EXPECT_GE(nearer, all * 95 / 100);
}

TEST(SignedDistance, small_shapes_far_from_their_origin_have_bounds_in_order) {
  // Known by its support mapping only, whose digits such a body has lost: lower was above upper.
  RandomShapes random(17);
  for (int k = 0; k < 3000; ++k) {
    const auto small = [&] {
      ShapeList balls;
      const Vec3<double> far = random.in(1, 10) * random.direction();
      for (int i = 0; i < 2; ++i)
        balls.push_back(Shape(Transform{Nested(Shape(Sphere{random.in(1e-4, 2e-4)})),
                                        shifted_by(far + 1e-4 * random.direction())}));
      return Shape(HullOf{balls});
    };
    const Body a(small(), {random.turn(), Vec3<double>::Zero()});
    Body b(small(), {random.turn(), random.direction()});
    const double size = testing::size_of(a, b);
    testing::bring_near(a, b, k % 2 == 0 ? 1e-3 : random.in(0, 1), size);
    const SignedDistance found = signed_distance(a, b);
    ASSERT_LE(found.lower, found.value) << k;
    ASSERT_LE(found.value, found.upper) << k;
  }
}

/// The bounds are as far apart as its own digits make them: that is no reason to be undecided.
TEST(SignedDistance, of_what_touches_far_from_its_own_origin_is_known_to_its_digits) {
  constexpr double far = 0x1p22;
  ShapeList balls;
  for (const double x : {far, far + 1})
    balls.push_back(Shape(Transform{Nested(Shape(Sphere{0.5})), shifted_by(x, 0, 0.5)}));
  const ContactShape rod(Shape(HullOf{balls})), table(Box{{2, 2, 0.5}});
  const Affine<double> here{shifted_by(-far, 0, 0)}, below{shifted_by(0, 0, -0.5)};
  const SignedDistance found = signed_distance(table, below, rod, here);
  EXPECT_EQ(found.status, SignedStatus::touching);
  EXPECT_LE(found.lower, 0);
  EXPECT_GE(found.upper, 0);
  EXPECT_LE(found.upper - found.lower, 32 * tolerance::epsilon<double> * far);
}

TEST(SignedDistance, is_undecided_where_squares_of_lengths_overflow) {
  const auto at = [](double radius, const Vec3<double>& centre) {
    return ContactShape(Transform{Nested(Shape(Sphere{radius})), shifted_by(centre)});
  };
  const Vec3<double> far(1e308, 1e308, 1e308);
  const ContactShape box(Box{{1e200, 1e200, 1e200}}), small(at(1, far)), opposite(at(1, -far)),
      large(at(1e200, Vec3<double>::Zero()));
  for (const auto& [a, b] : {std::pair(small, opposite), {large, small}, {box, small}}) {
    const SignedDistance found = signed_distance(a, b);
    EXPECT_EQ(found.status, SignedStatus::undecided);
    EXPECT_LE(found.lower, found.value);
    EXPECT_LE(found.value, found.upper);
  }
}

/// The rim of a cone's other end was taken where both were as far to rounding, with a normal that
/// was off by up to 26 degrees: its planes were not as far apart as they should be.
TEST(SignedDistance, of_what_is_far_away_is_proven_by_its_plane) {
  RandomShapes random(17);
  const Affine<double> origin;
  for (const double far : {1e3, 1e7, 1e9, 1e12, 1e17, 1e50, 1e150})
    for (int kind = 0; kind < kinds_of_bodies; ++kind)
      for (int k = 0; k < 20; ++k) {
        const Body ball(Sphere{0.5}, origin),
            other(random_shape(kind, 1, random), {random.turn(), far * random.direction()});
        const SignedDistance found = signed_distance(ball, other);
        ASSERT_EQ(found.status, SignedStatus::separated) << kind << " at " << far;
        ASSERT_GE(double(testing::gap(ball, other, found.normal)), found.lower)
            << kind << " at " << far;
        ASSERT_LE(found.upper - found.lower, 1e-14 * far + 1e-9) << kind << " at " << far;
      }
}

/// If nothing is known the value is 0, and only is_unknown() distinguishes it from a contact.
TEST(SignedDistance, is_unknown_only_where_it_gave_up_without_bounds) {
  const ContactShape ball(Shape(Sphere{1})), box(Shape(Box{{1, 1, 1}}));
  const auto at = [](double x) { return shifted_by(x, 0, 0); };
  SignedDistanceOptions near, sign;
  near.at_most = 1;
  sign.only_sign = true;
  for (const ContactShape& shape : {ball, box}) {
    for (const double x : {0.0, 0.5, 2.0, 3.0, 1e6, 1e150})
      for (const SignedDistanceOptions& options : {SignedDistanceOptions{}, near, sign})
        EXPECT_FALSE(signed_distance(ball, at(0), shape, at(x), options).is_unknown()) << x;
    for (const double x : {1e155, 1e200, 1e308})
      EXPECT_TRUE(signed_distance(ball, at(0), shape, at(x)).is_unknown()) << x;
  }
}

/// A third of all pairs was reported elsewhere, or as overlapping, at sizes of 1e-90 and 2e78.
TEST(SignedDistance, of_any_size_is_the_same_or_unknown) {
  for (const int power : {-500, -300, -200, -158, -100, 100, 155, 200, 300, 500})
    for (int k = 0; k < kinds_of_bodies * kinds_of_bodies; ++k) {
      RandomShapes random(k + 1), again(k + 1);
      const double scale = std::ldexp(1.0, power);
      const int kind_a = k % kinds_of_bodies, kind_b = k / kinds_of_bodies;
      const auto found = [&](RandomShapes& numbers, double size) {
        const ContactShape a(random_shape(kind_a, size, numbers)),
            b(random_shape(kind_b, size, numbers));
        const Affine<double> pose{numbers.turn(), size * numbers.in(0, 3) * numbers.direction()};
        return signed_distance(a, {}, b, pose);
      };
      const SignedDistance of_one = found(random, 1), scaled = found(again, scale);
      if (scaled.is_unknown()) {
        ASSERT_GE(std::abs(power), 155) << kind_a << ", " << kind_b;
        continue;
      }
      ASSERT_LE(scaled.lower / scale, of_one.upper + 1e-12)
          << power << ": " << kind_a << ", " << kind_b;
      ASSERT_GE(scaled.upper / scale, of_one.lower - 1e-12)
          << power << ": " << kind_a << ", " << kind_b;
      ASSERT_LE(scaled.lower, scaled.upper);
    }
}

/// Compared with lengths that count they are points.
TEST(SignedDistance, of_segments_too_short_for_products_is_that_of_points) {
  RandomShapes random(18);
  for (const double length : {1e-60, 1e-66, 1e-70, 1e-100, 1e-155, 1e-200, 1e-300})
    for (const double other : {1.0, length}) {
      const ContactShape a(random_shape(1, other, random)), b(random_shape(1, length, random));
      const Affine<double> pose{random.turn(), 3 * random.direction()};
      const SignedDistance found = signed_distance(a, {}, b, pose),
                           of_point = signed_distance(a, {}, ContactShape(Point{}), pose);
      EXPECT_NEAR(found.value, of_point.value, 1e-14) << length << " beside " << other;
      EXPECT_LT((found.normal - of_point.normal).norm(), 1e-14) << length << " beside " << other;
      EXPECT_LE(found.upper - found.lower, 1e-13) << length << " beside " << other;
    }
}

/// If squares of lengths are out of range a ball far above the plane touched it.
TEST(SignedDistance, of_a_half_space_is_known_as_far_as_numbers_go) {
  const ContactShape ball(Shape(Sphere{1}));
  const Vec3<double> up(0, 0, 1);
  const auto above = [&](double z, double offset) {
    return distance_to_half_space(up, offset, ball, shifted_by(0, 0, z));
  };
  for (const double z : {3.0, 1e100, 1e155, 1e300}) {
    EXPECT_EQ(above(z, 0).status, SignedStatus::separated) << z;
    EXPECT_EQ(above(-z, 0).status, SignedStatus::overlapping) << z;
  }
  EXPECT_TRUE(above(1.5e308, -1.5e308).is_unknown());
  const ContactShape infinite(Shape(Sphere{std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(distance_to_half_space(up, 0, infinite, {}).is_unknown());
  // The ball touches the plane, but the bound of its rounding is out of range.
  const ContactShape huge(Shape(Sphere{1e308}));
  EXPECT_TRUE(distance_to_half_space(up, 0, huge, shifted_by(0, 0, 1e308)).is_unknown());
  // Bounds that are open to both sides of 0 are known all the same.
  SignedDistance undecided;
  undecided.upper = 1;
  EXPECT_FALSE(undecided.is_unknown());
}

}  // namespace
}  // namespace minkray
