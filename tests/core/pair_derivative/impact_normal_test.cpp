// SPDX-License-Identifier: MIT
// Normals of first contacts of bodies that do not turn: as accurate as derivatives need, and no
// further from those of an oracle in long double (tests/oracle/long_distance.h) than estimated.
#include <gtest/gtest.h>

#include "tests/core/pair_derivative/derivative_judge.h"
#include "tests/support/number_of_cases.h"

namespace minkray::testing {
namespace {

struct MovingBodies {
  Body a, b;
  RigidMotion of_a, of_b;
  double size;
};

/// Two bodies apart; the second one moves to about the first one's middle, and through it.
MovingBodies moving_bodies(int i, int j, int k, RandomShapes& random) {
  const RandomPair pair = derived_pair(i, j, k, random);
  MovingBodies moving{pair.a, pair.b, {pair.a.pose}, {pair.b.pose}, size_of(pair.a, pair.b)};
  const Vec3<double> where = random.in(1, 2) * moving.size * random.direction();
  moving.of_b.pose.translation = moving.of_a.pose.translation + where;
  moving.of_b.velocity = -2 * where + 0.3 * moving.size * random.direction();
  return moving;
}

/// The true normal at the time of the contact; the zero vector if the oracle finds none.
Real3 true_normal(const MovingBodies& moving, const Impact& found) {
  using Long = long double;
  const WithoutRadius core_a = without_radius(moving.a.shape),
                      core_b = without_radius(moving.b.shape);
  LongBody a{&core_a.shape, moving.of_a.pose.cast<Long>()};
  LongBody b{&core_b.shape, moving.of_b.pose.cast<Long>()};
  // Far from the origin, long double has few digits, too.
  b.pose.translation -= a.pose.translation;
  a.pose.translation.setZero();
  const Real3 velocity = moving.of_b.velocity.cast<Long>();
  b.pose.translation += Long(found.t_lo) * velocity;
  const Long radii = core_a.radius + core_b.radius;
  Real3 normal = found.normal.cast<Long>();
  // From t_lo to the contact, by Newton's method.
  for (int step = 0; step < 3; ++step) {
    Long gap = 0;
    if (radii > 1e-3L * moving.size) {
      const LongDistance apart = long_distance(a, b, normal);
      normal = apart.normal;
      gap = apart.upper - radii;
    } else {
      const LongDepth depth = climb(a, b, normal, moving.size);
      if (!(depth.unsure <= 1e-14L * moving.size)) return Real3::Zero();
      normal = depth.normal;
      gap = depth.value - radii;
    }
    b.pose.translation += gap / -normal.dot(velocity) * velocity;
  }
  return normal;
}

TEST(ImpactNormals, are_as_accurate_as_derivatives_need) {
  RandomShapes random(91);
  const int rounds = number_of_cases(2);
  int hits = 0, estimated = 0;
  for (int i = 0; i < kinds_of_derived_bodies; ++i)
    for (int j = 0; j < kinds_of_derived_bodies; ++j)
      for (int k = 0; k < rounds; ++k) {
        const MovingBodies moving = moving_bodies(i, j, k, random);
        ImpactOptions options;
        options.is_for_derivatives = true;
        const Impact found =
            first_impact(moving.a.ready, moving.of_a, moving.b.ready, moving.of_b, 2, options);
        const Impact plain =
            first_impact(moving.a.ready, moving.of_a, moving.b.ready, moving.of_b, 2);
        ASSERT_EQ(found.status, plain.status);
        ASSERT_EQ(found.t_lo, plain.t_lo);
        ASSERT_EQ(found.t_hi, plain.t_hi);
        if (found.status != ImpactStatus::hit) continue;
        const PairDerivative derivative =
            derivative_of(moving.a.ready, moving.of_a, moving.b.ready, moving.of_b, found);
        if (derivative.is_ridge) continue;
        const Real3 normal = true_normal(moving, found);
        if (normal.isZero(0)) continue;
        ++hits;
        const std::string where = std::string(name_of_derived(i)) + ", " +
                                  std::string(name_of_derived(j)) + " " + std::to_string(k);
        if (std::isfinite(found.normal_error)) {
          ++estimated;
          const double error =
              static_cast<double>((found.normal.cast<long double>() - normal).norm());
          constexpr double of_oracle = 1e-8;
          EXPECT_LE(error, found.normal_error + of_oracle) << where;
        }
        // The derivative by B's velocity is the normal divided by the closing speed.
        const Real3 velocity = moving.of_b.velocity.cast<long double>();
        const Real3 truth = normal / -normal.dot(velocity);
        const double error = static_cast<double>(
            (derivative.b.by_velocity.cast<long double>() - truth).norm() / truth.norm());
        EXPECT_LE(error, 1e-6) << where << " " << found.normal_error;
      }
  const int pairs = kinds_of_derived_bodies * kinds_of_derived_bodies;
  EXPECT_GT(hits, rounds * pairs / 3);
  // The search itself finds the normals of most curved pairs; polytopes need no estimate.
  EXPECT_GT(estimated, hits / 2);
}

TEST(ImpactNormals, faces_that_meet_are_ridges) {
  const Shape box = Box{{0.8, 0.5, 0.7}};
  const Shape lens = HullOf{{Shape(Capsule{0.1, 0.5}), Shape(Ellipsoid{{0.3, 0.2, 0.4}})}};
  const ContactShape flat((Shape(box))), grown(Shape(MinkowskiSum{{lens, box}}));
  RandomShapes random(92);
  for (int i = 0; i < 40; ++i) {
    RigidMotion of_a, of_b;
    of_a.pose.linear = of_b.pose.linear = random.turn();
    of_a.pose.translation = of_a.pose.linear * Vec3<double>(random.in(-1, 1), 3, random.in(-1, 1));
    of_a.velocity = of_a.pose.linear * Vec3<double>(random.in(-1, 1), -4, random.in(-1, 1));
    ImpactOptions options;
    options.is_for_derivatives = true;
    const Impact found = first_impact(grown, of_a, flat, of_b, 2, options);
    ASSERT_EQ(found.status, ImpactStatus::hit);
    EXPECT_TRUE(derivative_of(grown, of_a, flat, of_b, found).is_ridge) << found.normal_error;
  }
}

}  // namespace
}  // namespace minkray::testing
