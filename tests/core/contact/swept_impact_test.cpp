// SPDX-License-Identifier: MIT
// Times of impact of bodies that do not turn, which are found in one go, beside those of the steps
// that bodies which turn need.
#include <gtest/gtest.h>

#include <array>

#include "core/contact/impact.h"
#include "tests/core/contact/pair_judge.h"

namespace minkray::testing {
namespace {

struct Moving {
  Body a, b;
  RigidMotion of_a, of_b;
  double t_max;

  double size() const { return a.ready.ball_radius() + b.ready.ball_radius(); }
  double speed() const { return (of_b.velocity - of_a.velocity).norm(); }
  Body a_at(double t) const { return {a.shape, of_a.at(t)}; }
  Body b_at(double t) const { return {b.shape, of_b.at(t)}; }
};

Moving moving(int k, RandomShapes& random) {
  const auto shape = [&](int kind) {
    return k % 11 == 10 ? slender_shape(100, random) : random_shape(kind, 1, random);
  };
  const Affine<double> at_a{random.turn(), Vec3<double>::Zero()},
      at_b{k % 7 == 0 ? at_a.linear : random.turn(), random.in(1, 4) * random.direction()};
  const Vec3<double> of_a = random.in(0, 1) * random.direction(),
                     towards = at_b.translation + random.in(0, 1) * random.direction();
  return {Body(shape(k % kinds_of_bodies), at_a),
          Body(shape(k / kinds_of_bodies % kinds_of_bodies), at_b), RigidMotion{at_a, of_a},
          RigidMotion{at_b, of_a - random.in(0.2, 2) * towards}, random.in(0.3, 3)};
}

/// What is wrong with the first contact that is told.
std::string contact_complaint(const Moving& pair, const Impact& found, RandomShapes& random) {
  const double size = pair.size();
  const auto apart_at = [&](double t) {
    return signed_distance(pair.a.ready, pair.of_a.at(t), pair.b.ready, pair.of_b.at(t));
  };
  if (apart_at(found.t_lo).upper < -1e-13 * size) return "too late";
  if (apart_at(found.t_hi).lower > 2e-10 * size) return "apart at t_hi";
  if ((found.t_hi - found.t_lo) * pair.speed() > 2e-10 * size) return "wide";
  const Body a = pair.a_at(found.t_lo), b = pair.b_at(found.t_lo);
  if (std::abs(gap(a, b, found.normal)) > 2e-10 * size) return "the normal is of no contact";
  if ((found.point_b - found.point_a).norm() > 2e-10 * size) return "points apart";
  if (outside(a, found.point_a, found.normal, random) > 1e-10 * size) return "point_a outside of A";
  if (outside(b, found.point_b, -found.normal, random) > 1e-10 * size)
    return "point_b outside of B";
  return "";
}

TEST(SweptImpact, is_that_of_steps) {
  RandomShapes random(31);
  std::array<int, 4> statuses = {};
  int by_steps = 0;
  for (int k = 0; k < 20 * kinds_of_bodies * kinds_of_bodies; ++k) {
    const Moving pair = moving(k, random);
    const Impact found = first_impact(pair.a.ready, pair.of_a, pair.b.ready, pair.of_b, pair.t_max);
    // A turn of next to nothing takes steps.
    RigidMotion turning = pair.of_b;
    turning.angular_velocity = Vec3<double>(0, 0, 1e-100);
    const Impact steps = first_impact(pair.a.ready, pair.of_a, pair.b.ready, turning, pair.t_max);
    ASSERT_EQ(found.status, steps.status) << "pair " << k;
    ++statuses[static_cast<std::size_t>(found.status)];
    by_steps += found.status == ImpactStatus::hit && found.steps > 0;
    if (found.status != ImpactStatus::hit) continue;
    EXPECT_EQ(contact_complaint(pair, found, random), "") << "pair " << k;
    EXPECT_LE(steps.t_lo, found.t_hi) << "pair " << k;
    // Steps count as touching what is so near.
    EXPECT_LE(found.t_lo, steps.t_hi + 1e-9 * pair.size() / pair.speed()) << "pair " << k;
  }
  EXPECT_GT(statuses[static_cast<std::size_t>(ImpactStatus::hit)], 2000);
  EXPECT_GT(statuses[static_cast<std::size_t>(ImpactStatus::miss)], 1000);
  EXPECT_LT(by_steps, 20);
}

TEST(SweptImpact, of_polytopes_is_exact) {
  // A corner of a unit cube on its diagonal meets a plate.
  const ContactShape cube(Shape<double>(Box<double>{{0.5, 0.5, 0.5}})),
      plate(Shape<double>(Box<double>{{5, 5, 0.25}}));
  const Mat3<double> on_diagonal =
      Eigen::Quaterniond::FromTwoVectors(Vec3<double>(1, 1, 1), Vec3<double>(0, 0, -1))
          .toRotationMatrix();
  const RigidMotion still{{Mat3<double>::Identity(), Vec3<double>::Zero()}},
      falling{{on_diagonal, Vec3<double>(0.3, 0.2, 4)}, Vec3<double>(0.1, 0.2, -2)};
  const Impact found = first_impact(plate, still, cube, falling, 10);
  const double exact = (4 - 0.25 - std::sqrt(0.75)) / 2;
  ASSERT_EQ(found.status, ImpactStatus::hit);
  EXPECT_LE(found.t_lo, exact);
  EXPECT_GE(found.t_hi, exact);
  EXPECT_LT(found.t_hi - found.t_lo, 1e-13);
  EXPECT_NEAR(found.point_a.x(), 0.3 + 0.1 * exact, 1e-13);
  EXPECT_NEAR(found.point_a.y(), 0.2 + 0.2 * exact, 1e-13);
  EXPECT_NEAR(found.normal.z(), 1, 1e-15);
}

TEST(SweptImpact, of_a_miss_tells_the_distance_at_the_end_if_it_is_asked_for) {
  const ContactShape ball(Shape<double>(Sphere<double>{1}));
  const RigidMotion still{{Mat3<double>::Identity(), Vec3<double>::Zero()}},
      passing{{Mat3<double>::Identity(), Vec3<double>(-5, 3, 0)}, Vec3<double>(1, 0, 0)};
  const Impact found = first_impact(ball, still, ball, passing, 5);
  ASSERT_EQ(found.status, ImpactStatus::miss);
  EXPECT_NEAR(found.distance, 1, 1e-14);
  EXPECT_NEAR(found.point_a.y(), 1, 1e-14);
  ImpactOptions options;
  options.points_of_misses = false;
  EXPECT_EQ(first_impact(ball, still, ball, passing, 5, options).steps, 0);
}

}  // namespace
}  // namespace minkray::testing
