// SPDX-License-Identifier: MIT
// Signed distances are judged by planes and points of the shapes' own support mappings, which the
// solvers do not use.
#include "core/contact/signed_distance.h"

#include <gtest/gtest.h>

#include "tests/core/contact/random_bodies.h"

namespace minkray {
namespace {

using testing::Body;
using testing::kinds_of_bodies;
using testing::random_shape;
using testing::RandomShapes;

/// The gap between planes with normal n.
double gap(const Body& a, const Body& b, const Vec3<double>& n) {
  const Vec3<double> from = a.pose.translation;
  return static_cast<double>(-b.support_function(-n, from) - a.support_function(n, from));
}

/// The largest gap that a search at random finds.
double best_gap(const Body& a, const Body& b, RandomShapes& random) {
  Vec3<double> best = random.direction();
  double largest = gap(a, b, best), step = 0.3;
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> n =
        i < 40 ? random.direction() : Vec3<double>((best + step * random.direction()).normalized());
    const double found = gap(a, b, n);
    if (found > largest) {
      largest = found;
      best = n;
    } else if (i >= 40) {
      step *= 0.8;
    }
  }
  return largest;
}

/// How far a point is outside of a body, as far as some directions tell.
double outside(const Body& body, const Vec3<double>& point, const Vec3<double>& normal,
               RandomShapes& random) {
  double most = 0;
  for (int i = 0; i < 12; ++i) {
    Vec3<double> n = normal;
    if (i >= 8) n = random.direction();
    if (i > 0 && i < 8) n += 1e-3 * random.direction();
    most = std::max(most, static_cast<double>(-body.support_function(n, point)));
  }
  return most;
}

struct Seen {
  int separated = 0, overlapping = 0, touching = 0, all = 0;
};

void expect_proven(const Body& a, const Body& b, const SignedDistance& result, RandomShapes& random,
                   Seen& seen) {
  const double size = a.ready.ball_radius() + b.ready.ball_radius();
  const double reaches = size + a.ready.middle().norm() + b.ready.middle().norm() +
                         (b.pose.translation - a.pose.translation).norm();
  const double rounding = 16 * tolerance::epsilon<double> * reaches;
  EXPECT_NE(result.status, SignedStatus::undecided);
  EXPECT_LE(result.lower, result.value);
  EXPECT_LE(result.value, result.upper);
  EXPECT_LE(result.upper - result.lower, 1e-9 * size + 4 * rounding);
  // The plane proves the lower bound, and no plane is better than the upper one.
  EXPECT_NEAR(result.normal.norm(), 1, 1e-14);
  EXPECT_LE(result.lower, gap(a, b, result.normal) + rounding);
  EXPECT_GE(result.upper, best_gap(a, b, random) - rounding);
  // The points are of the shapes, and as far from each other.
  const double far = rounding + 4 * tolerance::epsilon<double> * a.pose.translation.norm();
  const double near = (result.status == SignedStatus::separated ? 1e-11 : 1e-8) * size + far;
  EXPECT_LE(((result.point_b - result.point_a) - result.value * result.normal).norm(),
            3e-6 * size + far);
  EXPECT_LE(outside(a, result.point_a, result.normal, random), near);
  EXPECT_LE(outside(b, result.point_b, -result.normal, random), near);
  seen.separated += result.status == SignedStatus::separated;
  seen.overlapping += result.status == SignedStatus::overlapping;
  seen.touching += result.status == SignedStatus::touching;
  ++seen.all;
}

TEST(SignedDistance, random_pairs_of_all_kinds_are_proven_by_planes_and_points) {
  RandomShapes random(31);
  Seen seen;
  for (int i = 0; i < kinds_of_bodies; ++i)
    for (int j = 0; j < kinds_of_bodies; ++j)
      for (int k = 0; k < 24; ++k) {
        // Scales of all sizes, and far origins.
        const double scale = k % 6 == 5 ? std::pow(10, random.in(-3, 3)) : 1;
        const double other = k % 8 == 7 ? scale * std::pow(10, random.in(-2, 2)) : scale;
        const Vec3<double> origin =
            k % 5 == 4 ? 1e4 * scale * random.direction() : Vec3<double>(Vec3<double>::Zero());
        const Body a(random_shape(i, scale, random), {random.turn(), origin});
        Body b(random_shape(j, other, random), {random.turn(), origin});
        const double size = a.ready.ball_radius() + b.ready.ball_radius() + scale;
        b.pose.translation += random.in(0, 1.3) * size * random.direction();
        if (k % 3 == 2) {
          // To touching, or nearly.
          const SignedDistance first = signed_distance(a.ready, a.pose, b.ready, b.pose);
          const double left = k % 2 == 0 ? 0 : std::pow(10, random.in(-14, -3)) * size;
          b.pose.translation -= (first.value - left * (k % 4 < 2 ? 1 : -1)) * first.normal;
        }
        const SignedDistance result = signed_distance(a.ready, a.pose, b.ready, b.pose);
        expect_proven(a, b, result, random, seen);
        if (HasFailure())
          FAIL() << "kinds " << i << " and " << j << ", " << k << ": value " << result.value
                 << " in [" << result.lower << ", " << result.upper << "]";
      }
  EXPECT_GT(seen.separated, seen.all / 4);
  EXPECT_GT(seen.overlapping, seen.all / 4);
  EXPECT_GT(seen.touching, seen.all / 100);
}

TEST(SignedDistance, the_order_of_the_two_turns_the_normal_and_nothing_else) {
  RandomShapes random(11);
  for (int k = 0; k < 2000; ++k) {
    const Body a(random_shape(k % kinds_of_bodies, 1, random),
                 {random.turn(), Vec3<double>::Zero()});
    const Body b(random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random),
                 {random.turn(), random.in(0, 3) * random.direction()});
    const SignedDistance one = signed_distance(a.ready, a.pose, b.ready, b.pose),
                         two = signed_distance(b.ready, b.pose, a.ready, a.pose);
    ASSERT_LE(one.lower, two.upper) << k;
    ASSERT_LE(two.lower, one.upper) << k;
    const double size = a.ready.ball_radius() + b.ready.ball_radius();
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
    const SignedDistance whole = signed_distance(a.ready, a.pose, b.ready, b.pose);
    SignedDistanceOptions near;
    near.at_most = 0.3;
    const SignedDistance bounded = signed_distance(a.ready, a.pose, b.ready, b.pose, near);
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
    const SignedDistance signs = signed_distance(a.ready, a.pose, b.ready, b.pose, sign);
    if (std::abs(whole.value) > 1e-9) {
      ASSERT_EQ(signs.status, whole.status) << k;
    }
    overlapping += whole.status == SignedStatus::overlapping;
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(overlapping, 300);
}

}  // namespace
}  // namespace minkray
