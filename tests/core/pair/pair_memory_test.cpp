// SPDX-License-Identifier: MIT
// The memory of a pair is only where a search begins, never the basis of its result: for any
// memory the bounds hold, and are as near to each other.
#include "core/pair/pair_memory.h"

#include <gtest/gtest.h>

#include "core/pair_motion/impact.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

/// Contents from another pair, and arbitrary ones.
PairMemory garbage(int k, RandomShapes& random) {
  PairMemory memory;
  memory.axis = random.direction();
  memory.count = static_cast<std::int32_t>(random.in(-3, 9));
  const double most = k % 3 == 0 ? 2 : k % 3 == 1 ? 70 : 1e9;
  for (int i = 0; i < 4; ++i) {
    memory.feature_a[i] = static_cast<std::int32_t>(random.in(k % 5 == 0 ? -most : 0, most));
    memory.feature_b[i] = static_cast<std::int32_t>(random.in(k % 5 == 0 ? -most : 0, most));
    // One point several times, or points in a line.
    if (i > 0 && k % 4 == 3) memory.feature_b[i] = memory.feature_b[0];
    if (i > 0 && k % 8 == 7) memory.feature_a[i] = memory.feature_a[0];
  }
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  if (k % 7 == 5) memory.axis.x() = not_a_number;
  if (k % 7 == 6) memory.axis *= random.in(0, 1e6);
  return memory;
}

TEST(PairMemory, garbage_in_it_changes_no_promise) {
  RandomShapes random(37);
  int separated = 0, overlapping = 0, all = 0;
  for (int k = 0; k < 12 * kinds_of_bodies * kinds_of_bodies; ++k) {
    const RandomPair pair =
        random_pair(k % kinds_of_bodies, k / kinds_of_bodies % kinds_of_bodies, k, random);
    PairMemory memory = garbage(k, random);
    const SignedDistance result = signed_distance(pair.a, pair.b, memory);
    ASSERT_EQ(complaint(pair.a, pair.b, result, random), "") << k;
    separated += result.status == SignedStatus::separated;
    overlapping += result.status == SignedStatus::overlapping;
    ++all;
    SignedDistanceOptions sign;
    sign.only_sign = true;
    memory = garbage(k, random);
    const SignedDistance signs = signed_distance(pair.a, pair.b, memory, sign);
    ASSERT_LE(signs.lower, result.upper) << k;
    const double size = size_of(pair.a, pair.b);
    if (std::abs(result.value) > 1e-9 * size) {
      ASSERT_EQ(signs.status, result.status) << k;
    }
  }
  EXPECT_GT(separated, all / 4);
  EXPECT_GT(overlapping, all / 5);
}

TEST(PairMemory, corners_of_one_plane_in_it_are_not_taken_for_an_overlap) {
  // Four corners of two boxes' faces, in one plane with the origin: rounding alone decides if that
  // is inside of their tetrahedron.
  const Body a(Shape(Box{{1, 1, 1}}), {}), b(Shape(Box{{1, 1, 1}}), shifted_by(5, 0.3, 0.1));
  RandomShapes random(5);
  for (int k = 0; k < 4096; ++k) {
    PairMemory memory;
    memory.axis = random.direction();
    memory.count = 4;
    for (int i = 0; i < 4; ++i) {
      memory.feature_a[i] = (k >> i & 1) != 0 ? 1 : 3;
      memory.feature_b[i] = static_cast<std::int32_t>(random.in(0, 8));
    }
    SignedDistanceOptions sign;
    sign.only_sign = k % 2 == 0;
    const SignedDistance result = signed_distance(a, b, memory, sign);
    ASSERT_EQ(result.status, SignedStatus::separated) << k;
    ASSERT_NEAR(result.value, 3, 1e-12) << k;
  }
}

TEST(PairMemory, of_bodies_that_tumble_saves_supports_and_changes_no_promise) {
  RandomShapes random(41);
  constexpr int frames = 24;
  long kept = 0, anew = 0;
  for (int n = 0; n < 4 * kinds_of_bodies * kinds_of_bodies; ++n) {
    RandomPair pair =
        random_pair(n % kinds_of_bodies, n / kinds_of_bodies % kinds_of_bodies, 0, random);
    const Vec3<double> velocity = random.in(0, 0.02) * random.direction(),
                       axis = random.direction();
    PairMemory memory;
    for (int frame = 0; frame < frames; ++frame) {
      const SignedDistance result = signed_distance(pair.a, pair.b, memory);
      ASSERT_EQ(complaint(pair.a, pair.b, result, random), "") << n << ", frame " << frame;
      // Nothing is kept of bodies known by their support mapping only.
      const bool is_known = pair.a.ready.core().kind != CoreKind::other &&
                            pair.b.ready.core().kind != CoreKind::other;
      if (frame > 0 && is_known && result.status == SignedStatus::separated) {
        kept += result.supports;
        anew += signed_distance(pair.a, pair.b).supports;
      }
      pair.b.pose.translation += velocity;
      pair.b.pose.linear =
          Eigen::AngleAxis<double>(0.02, axis).toRotationMatrix() * pair.b.pose.linear;
    }
  }
  EXPECT_LT(static_cast<double>(kept), 0.7 * static_cast<double>(anew));
}

TEST(PairMemory, garbage_moves_no_time_of_impact_beyond_its_bounds) {
  RandomShapes random(43);
  int hits = 0, misses = 0;
  for (int k = 0; k < 4000; ++k) {
    const RandomPair pair =
        random_pair(k % kinds_of_bodies, k / kinds_of_bodies % kinds_of_bodies, 0, random);
    const bool is_turning = k % 4 == 0;
    const Vec3<double> turn =
        is_turning ? Vec3<double>(random.direction()) : Vec3<double>(Vec3<double>::Zero());
    const RigidMotion a{pair.a.pose},
        b{pair.b.pose,
          random.in(0, 2) * (pair.a.pose.translation - pair.b.pose.translation +
                             random.in(0, 1) * random.direction()),
          turn};
    const Impact anew = first_impact(pair.a.ready, a, pair.b.ready, b, 1);
    PairMemory memory = garbage(k, random);
    for (int again = 0; again < 2; ++again) {
      const Impact kept = first_impact(pair.a.ready, a, pair.b.ready, b, 1, memory);
      ASSERT_EQ(kept.status, anew.status) << k;
      if (anew.status != ImpactStatus::hit) continue;
      ASSERT_LE(kept.t_lo, anew.t_hi) << k;
      ASSERT_LE(anew.t_lo, kept.t_hi) << k;
    }
    hits += anew.status == ImpactStatus::hit;
    misses += anew.status == ImpactStatus::miss;
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(PairMemory, has_an_axis_if_that_is_of_unit_length_but_for_single_precision) {
  PairMemory memory;
  EXPECT_FALSE(memory.has_axis());
  const Vec3<double> unit_length = Vec3<double>(2, -3, 6) / 7;
  for (const double longer : {0.0, 3e-7, -3e-7, 3e-6, -3e-6, 1.0}) {
    memory.axis = (1 + longer) * unit_length;
    EXPECT_EQ(memory.has_axis(), std::abs(longer) < 1e-6) << longer;
  }
  memory.axis.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(memory.has_axis());
}

TEST(PairMemory, cores_have_so_many_features) {
  const auto count = [](const Shape& shape) {
    const ContactShape ready(shape);
    int found = 0;
    for (int feature = -20; feature < 20; ++feature)
      found += is_feature_of(ready.core(), feature) ? 1 : 0;
    return found;
  };
  EXPECT_EQ(count(Sphere{1}), 1);
  EXPECT_EQ(count(Ellipsoid{{1, 2, 3}}), 1);
  EXPECT_EQ(count(Capsule{1, 1}), 2);
  EXPECT_EQ(count(Cylinder{1, 1}), 2);
  EXPECT_EQ(count(Box{{1, 1, 1}}), 8);
}

}  // namespace
}  // namespace minkray::testing
