// SPDX-License-Identifier: MIT
#include "renderer/paper/rotating_cast.h"

#include <gtest/gtest.h>

#include "renderer/paper/distance.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using V = Vec3<double>;

struct MovingBody {
  Shape shape;
  RigidMotion motion;
};

RotatingCastResult cast(const MovingBody& a, const MovingBody& b, double duration, int steps) {
  return cast_rotating(a.shape, a.motion, b.shape, b.motion, duration, steps);
}

// A bar that turns about its middle, a ball next to it: they meet when the bar's flat side has
// turned up to the ball.
MovingBody bar() {
  return {Box{{2, 0.1, 0.1}}, {{}, V::Zero(), V(0, 0, 1)}};
}
MovingBody ball() {
  return {Sphere{0.25}, {shifted_by(V(0, 1.5, 0))}};
}
// The ball's centre is sin(angle between) * 1.5 = 0.35 off the bar's axis: 90 degrees less that.
const double truth = std::acos(-1.0) / 2 - std::asin(0.35 / 1.5);

TEST(RotatingCast, approaches_the_truth_as_steps_shrink_and_never_claims_more) {
  for (const int steps : {8, 32, 128, 512}) {
    const auto result = cast(bar(), ball(), 2.0, steps);
    ASSERT_EQ(result.status, Status::hit) << steps;
    EXPECT_LE(result.t_lo, truth) << steps;
    EXPECT_NEAR(result.t, truth, 2.0 / steps) << steps;
    // At the claimed time the true bodies are as near as the stated bound.
    const auto distance = distance_between(centred(bar().shape, bar().motion.at(result.t)),
                                           centred(ball().shape, ball().motion.at(result.t)));
    EXPECT_LE(distance.distance, result.position_error) << steps;
    EXPECT_LE(result.position_error, 2.1 / steps) << steps;
  }
}

/// There is a normal also where the orientation's change at once has put them into each other.
TEST(RotatingCast, every_hit_has_a_normal_between_the_two) {
  testing::Random random(4);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    MovingBody a = bar(), b = bar();
    b.motion.pose.translation = 2.2 * random.direction();
    a.motion.angular_velocity = 3 * random.direction();
    b.motion.angular_velocity = 3 * random.direction();
    a.motion.velocity = 0.5 * random.direction();
    const auto result = cast(a, b, 2.0, 12);
    if (result.status != Status::hit) continue;
    ++hits;
    ASSERT_NEAR(result.normal.norm(), 1, 1e-12) << i;
    // From A, outward: towards B.
    const V towards =
        b.motion.pose.translation - (a.motion.pose.translation + result.t * a.motion.velocity);
    EXPECT_GT(result.normal.dot(towards), 0) << i;
  }
  EXPECT_GT(hits, 30);
}

TEST(RotatingCast, without_turning_is_the_shape_cast) {
  MovingBody a = bar(), b = ball();
  a.motion.angular_velocity.setZero();
  b.motion.velocity = V(0.1, -1, 0);
  const auto result = cast(a, b, 2.0, 5);
  ASSERT_EQ(result.status, Status::hit);
  EXPECT_EQ(result.position_error, 0);
  EXPECT_NEAR(result.t, 1.5 - 0.35, 1e-14);
  EXPECT_NEAR(result.t_lo, result.t, 1e-14);
}

TEST(RotatingCast, bodies_go_straight_while_they_turn) {
  MovingBody body = bar();
  body.motion.pose.translation = V(1, 2, 3);
  body.motion.velocity = V(0.5, -1, 0.25);
  const Affine<double> then = body.motion.at(2.0);
  EXPECT_EQ(then.translation, V(2, 0, 3.5));
  EXPECT_NEAR(then.linear(1, 0), std::sin(2), 1e-15);
}

TEST(RotatingCast, the_points_of_contact_are_where_the_bodies_are_by_then) {
  // The first runs into the second.
  MovingBody a = ball(), b = ball();
  a.motion.velocity = V(0, 3, 0.25);
  b.motion.pose.translation = V(0, 4, 0.25);
  b.motion.velocity = V(0, 1, 0);
  const auto result = cast(a, b, 2.0, 5);
  ASSERT_EQ(result.status, Status::hit);
  EXPECT_NEAR(result.t, 1, 1e-14);
  EXPECT_LT((result.point_a - V(0, 4.75, 0.25)).norm(), 1e-13);
  EXPECT_LT((result.point_b - V(0, 4.75, 0.25)).norm(), 1e-13);
}

/// A step ends a rounding error before the contact, and the next one begins with it.
TEST(RotatingCast, contacts_at_the_seam_of_two_steps_have_the_normal_of_the_face) {
  MovingBody a = bar(), b = ball();
  a.motion.angular_velocity.setZero();
  a.motion.pose.translation = V(5, 7, 3);
  b.motion.velocity = V(0, -1, 0);
  for (const int seam : {1, 3, 6, 7, 9})
    for (int k = -20; k <= 20; ++k) {
      const double above = 0.35 + 0.1 * seam + std::ldexp(k, -51);
      b.motion.pose.translation = a.motion.pose.translation + V(0, above, 0);
      const auto result = cast(a, b, 1.0, 10);
      ASSERT_EQ(result.status, Status::hit) << seam << " " << k;
      EXPECT_NEAR(result.t, 0.1 * seam, 1e-13) << seam << " " << k;
      EXPECT_LT((result.normal - V(0, 1, 0)).norm(), 1e-12) << seam << " " << k;
    }
}

TEST(RotatingCast, a_miss_clear_of_the_bound_is_proven) {
  MovingBody far = ball();
  far.motion.pose.translation = V(0, 3, 0);
  const auto clear = cast(bar(), far, 6.0, 64);
  EXPECT_EQ(clear.status, Status::miss);
  EXPECT_TRUE(clear.proven);
  far.motion.pose.translation = V(0, 2.3, 0);  // the bar's corner passes at 0.0475 from the ball
  const auto close = cast(bar(), far, 6.0, 64);
  EXPECT_EQ(close.status, Status::miss);
  EXPECT_FALSE(close.proven);
  EXPECT_TRUE(cast(bar(), far, 6.0, 512).proven);
}

/// Squares of the slowest turns are 0: such turns were none, and the hit was a proven miss.
void expect_turns_of_any_speed(const std::vector<int>& powers) {
  const auto cast_at = [](int power) {
    const auto speed = [power](double x) { return static_cast<double>(std::ldexp(x, power)); };
    const MovingBody rod{Capsule{0.1, 5.0}, {{}, V::Zero(), {speed(0.01), speed(1), speed(-0.02)}}};
    const MovingBody beside{Sphere{1}, {shifted_by(4, 0, 0), {speed(-0.1), 0, speed(0.05)}}};
    return cast(rod, beside, static_cast<double>(std::ldexp(3.0, -power)), 64);
  };
  const auto once = cast_at(0);
  ASSERT_EQ(once.status, Status::hit);
  constexpr double allowed = 100 * std::numeric_limits<double>::epsilon();
  for (const int power : powers) {
    const auto other = cast_at(power);
    ASSERT_EQ(other.status, Status::hit) << power;
    EXPECT_NEAR(std::ldexp(double(other.t), power), double(once.t), allowed) << power;
    EXPECT_NEAR(std::ldexp(double(other.t_lo), power), double(once.t_lo), allowed) << power;
    EXPECT_NEAR(double(other.position_error), double(once.position_error), allowed) << power;
  }
}

TEST(RotatingCast, slow_and_fast_turns_are_turns) {
  expect_turns_of_any_speed({-1000, -565, -500, 500, 565, 1000});
}

}  // namespace
}  // namespace minkray
