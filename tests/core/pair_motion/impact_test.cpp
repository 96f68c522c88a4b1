// SPDX-License-Identifier: MIT
// Compares times of impact of bodies that move and turn with dense sampling and bisection in long
// double of closed forms.
#include "core/pair_motion/impact.h"

#include <gtest/gtest.h>

#include "tests/core/pair_motion/moving_pairs.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

TEST(Impact, of_turning_capsules_is_that_of_dense_samples) {
  RandomNumbers random(3);
  SeenImpacts seen;
  for (int k = 0; k < 3000; ++k)
    ASSERT_EQ(impact_complaint(moving_capsules(random), 200, seen), "") << k;
  EXPECT_GT(seen.hits, 900);
  EXPECT_GT(seen.misses, 900);
  EXPECT_LT(seen.width, 1e-6);
}

TEST(Impact, of_turning_boxes_is_that_of_dense_samples) {
  RandomNumbers random(4);
  SeenImpacts seen;
  for (int k = 0; k < 2000; ++k)
    ASSERT_EQ(impact_complaint(moving_boxes(random), 100, seen), "") << k;
  EXPECT_GT(seen.hits, 600);
  EXPECT_GT(seen.misses, 300);
  EXPECT_LT(seen.width, 1e-6);
}

TEST(Impact, of_crossing_capsules_that_approach_slowly_is_decided_in_few_steps) {
  // The axes turn fast and their distance falls slowly: a fixed plane soon cuts one of them.
  RigidMotion of_a, of_b;
  of_a.pose.linear << 0.53226241799961183, -0.37642450160836649, 0.75828841015414417,
      0.82753035432983235, 0.042399077121806239, -0.55981767650009184, 0.17857836108540323,
      0.92547658687192746, 0.33407013650420658;
  of_a.pose.translation << -3.0891076716691215, -9.4951571623806021, -0.54717844852233311;
  of_a.velocity << 0.025496095183992748, 0.022936616250680584, -0.026107256069338371;
  of_a.angular_velocity << -1.2907375844013633, 0.99737819598188426, 2.1427552951771052;
  of_b.pose.linear << 0.88262244106097332, -0.18114013220971162, 0.43378091133499269,
      -0.22506759148002253, -0.97297315097909753, 0.051651009081990815, 0.41270110952231559,
      -0.14321836466338528, -0.89953671088077058;
  of_b.pose.translation << -2.3763524341953346, -10.181009195506745, -1.7453035347277495;
  of_b.velocity << -1.2952140553925198, 0.21102097842054895, 1.2500819234634382;
  of_b.angular_velocity << 0.29997683850344853, 1.807978414713862, 0.052609233219322461;
  const MovingPair pair = capsules_of({0.3946222121207037, 0.49268178041126298},
                                      {0.40676878894759183, 0.597715567247737}, of_a, of_b, 1);
  SeenImpacts seen;
  EXPECT_EQ(impact_complaint(pair, 500, seen), "");
  EXPECT_EQ(seen.hits, 1);
  EXPECT_LT(first_impact(pair.a, of_a, pair.b, of_b, 1).steps, 200);
}

const ContactShape cube{Shape(Box{{1, 1, 1}})};

RigidMotion at(double x, double y, double z, const Vec3<double>& velocity,
               const Vec3<double>& angular = Vec3<double>::Zero()) {
  return {shifted_by(x, y, z), velocity, angular};
}

TEST(Impact, of_a_rod_that_leaves_with_one_end_is_that_of_the_other) {
  // The rod's left end lies on a cube. The right one is next to nothing above it, and comes down
  // as the rod turns.
  constexpr double tilt = 1e-7;
  ImpactOptions options;
  options.touching = 1e-6;
  const ContactShape rod{Shape(Capsule{0.125, 0.5})};
  RigidMotion motion = at(0, 0, 1.125 + tilt / 2, {0, 0, 0}, {0, 1, 0});
  motion.pose.linear << tilt, 0, 1, 0, 1, 0, -1, 0, tilt;  // axis along x
  motion.pose.linear.col(2) = Vec3<double>(1, 0, tilt);
  const Impact found = first_impact(cube, at(0, 0, 0, {0, 0, 0}), rod, motion, 1, options);
  ASSERT_EQ(found.status, ImpactStatus::hit);
  EXPECT_GE(found.t_lo, 0);
  EXPECT_LE(found.t_lo, 2 * tilt);
  EXPECT_GT(found.t_hi, 0);
  EXPECT_LT(found.t_hi, 1e-4);
  EXPECT_LT(signed_distance(cube, {}, rod, motion.at(found.t_hi)).lower, 0);
}

TEST(Impact, a_cube_that_turns_by_a_corner_meets_a_wall_when_its_diagonal_does) {
  // The corner's height above the middle is sqrt(2) sin(pi/4 + t): the wall is 1.3 away.
  const Impact impact =
      first_impact(cube, at(0, 0, 0, {0, 0, 0}, {0, 0, 1}), cube, at(2.3, 0, 0, {0, 0, 0}), 1);
  ASSERT_EQ(impact.status, ImpactStatus::hit);
  const double exact = std::asin(1.3 / std::sqrt(2)) - std::atan(1);
  EXPECT_LE(impact.t_lo, exact);
  EXPECT_GE(impact.t_hi, exact);
  EXPECT_LE(impact.t_hi - impact.t_lo, 1e-8);
  EXPECT_NEAR(impact.normal.x(), 1, 1e-12);
}

TEST(Impact, a_contact_at_the_start_counts_unless_the_two_part) {
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  EXPECT_EQ(first_impact(cube, rest, cube, at(2, 0, 0, {-1, 0, 0}), 1).status,
            ImpactStatus::inside);
  EXPECT_EQ(first_impact(cube, rest, cube, at(2, 0, 0, {0, 1, 0}), 1).status, ImpactStatus::inside);
  EXPECT_EQ(first_impact(cube, rest, cube, at(2, 0, 0, {1, 0, 0}), 1).status, ImpactStatus::miss);
  EXPECT_EQ(first_impact(cube, rest, cube, at(1.5, 0, 0, {1, 0, 0}), 1).status,
            ImpactStatus::inside);
}

/// The step away from a contact was as long as a part of their sizes, which are none: it was
/// repeated for ever. If points in one place part depends on a normal, which any direction is.
TEST(Impact, points_in_one_place_part_or_touch) {
  const ContactShape point{Shape(Point{{0, 0, 0}})};
  const RigidMotion rests = at(1, 2, 3, {0, 0, 0});
  int misses = 0;
  for (const double speed : {1.0, -1.0})
    for (int axis = 0; axis < 3; ++axis) {
      const RigidMotion turns = at(1, 2, 3, speed * Vec3<double>::Unit(axis), {0, 0, 1});
      const ImpactStatus status = first_impact(point, turns, point, rests, 1).status;
      EXPECT_TRUE(status == ImpactStatus::miss || status == ImpactStatus::inside);
      misses += status == ImpactStatus::miss;
    }
  EXPECT_GE(misses, 1);
}

/// Found by the fuzz target `query`, with a length that is infinite in float: at each of a hundred
/// times all support points of a distance's budget were used up, for a minute under sanitizers.
TEST(Impact, of_infinite_bodies_is_given_up_soon) {
  const double infinity = std::numeric_limits<double>::infinity();
  const ContactShape needle{Shape(Capsule{0.5, infinity})};
  const Shape superellipsoid = Superellipsoid{{1, 1, 1}, 4};
  const Affine<double> aside = shifted_by(4, 0, 0);
  const ContactShape body{Shape(Transform{superellipsoid, AffineMap(aside)})};
  const Impact impact =
      first_impact(needle, at(0, 0, 0, {1, 5e-324, 1}, {0, 0, 1}), body, at(0, 0, 0, {0, 0, 0}), 5);
  EXPECT_EQ(impact.status, ImpactStatus::undecided);
  EXPECT_EQ(impact.t_lo, 0);
  EXPECT_LE(impact.steps, 12);
}

TEST(Impact, what_grazes_is_a_hit_and_what_passes_is_a_miss) {
  const ContactShape ball(Shape(Sphere{1}));
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  const auto pass = [&](double beside) {
    return first_impact(ball, rest, ball, at(-5, beside, 0, {1, 0, 0}), 10).status;
  };
  EXPECT_EQ(pass(2), ImpactStatus::hit);
  EXPECT_EQ(pass(2 - 1e-6), ImpactStatus::hit);
  EXPECT_EQ(pass(2 + 1e-6), ImpactStatus::miss);
}

const ContactShape ball{Shape(Sphere{1})};

TEST(Impact, of_a_ball_that_leaves_and_comes_round_is_found_in_the_longest_time) {
  // Around (2, 1) with an arm of 1, from (2, 0): it is as far from the middle again as at the
  // start where that is mirrored on the line to (2, 1), at (1.2, 1.6).
  const Affine<double> arm{shifted_by(0, -1, 0)};
  const ContactShape on_arm{Shape(Transform{Shape(Sphere{1}), AffineMap(arm)})};
  const double exact = std::acos(-1.0) + std::asin(0.8);
  for (const double t_max : {10.0, 1e20, 1e30, 1e31, 1e33, 1e100, 1e300}) {
    const Impact found = first_impact(ball, at(0, 0, 0, {0, 0, 0}), on_arm,
                                      at(2, 1, 0, {0, 0, 0}, {0, 0, 1}), t_max);
    ASSERT_EQ(found.status, ImpactStatus::hit) << t_max;
    EXPECT_LE(found.t_lo, exact + 1e-9) << t_max;
    EXPECT_GE(found.t_hi, exact - 1e-9) << t_max;
    EXPECT_LE(found.t_hi - found.t_lo, 1e-6) << t_max;
    EXPECT_LT((found.normal - Vec3<double>(0.6, 0.8, 0)).norm(), 1e-6) << t_max;
  }
}

/// Parts so slowly that it is back, and into the other, before it would be apart at that speed.
TEST(Impact, of_a_ball_that_leaves_slowly_and_comes_back_is_not_leapt_over) {
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  for (const double slow : {1e-1, 1e-2, 1e-6, 1e-8, 2e-8}) {
    // The arm is (1, -slow) at first, from a pivot to the left, so that the ball moves by (slow,
    // 1). The ball is furthest where the arm leads along the way from the middle to the pivot.
    const Affine<double> arm{shifted_by(1, -slow, 0)};
    const ContactShape on_arm{Shape(Transform{Shape(Sphere{1}), AffineMap(arm)})};
    const double exact = 4 * std::atan(slow);
    const Impact found = first_impact(ball, rest, on_arm, at(1, slow, 0, {0, 0, 0}, {0, 0, 1}), 10);
    ASSERT_EQ(found.status, ImpactStatus::hit) << slow;
    EXPECT_LE(found.t_lo, exact + 1e-9) << slow;
    EXPECT_GE(found.t_hi, exact - 1e-9) << slow;
    EXPECT_LE(found.t_hi, exact + 1e-3) << slow;
  }
}

/// The two touch, and part more slowly than the second spins: more steps are needed than allowed
/// until they are apart, and nothing is known of any later time.
TEST(Impact, that_runs_out_of_steps_takes_no_more_and_proves_nothing) {
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0}), spins = at(2, 0, 0, {0.05, 0, 0}, {0, 0, 1});
  for (int steps = 1; steps <= 4; ++steps) {
    ImpactOptions few;
    few.max_steps = steps;
    const Impact found = first_impact(ball, rest, ball, spins, 1, few);
    ASSERT_EQ(found.status, ImpactStatus::undecided) << steps;
    EXPECT_EQ(found.t_lo, 0) << steps;
    EXPECT_EQ(found.t_hi, std::numeric_limits<double>::infinity()) << steps;
    EXPECT_LE(found.steps, steps);
  }
  EXPECT_EQ(first_impact(ball, rest, ball, spins, 1).status, ImpactStatus::miss);
}

TEST(Impact, of_a_miss_is_told_at_the_end_of_time) {
  for (const Vec3<double>& turn : {Vec3<double>(0, 0, 0), Vec3<double>(0, 0, 1)})
    for (const bool has_points : {false, true}) {
      ImpactOptions options;
      options.points_of_misses = has_points;
      const Impact found = first_impact(cube, at(0, 0, 0, {0, 0, 0}), cube,
                                        at(5, 0, 0, {0.25, 0, 0}, turn), 3, options);
      ASSERT_EQ(found.status, ImpactStatus::miss);
      EXPECT_EQ(found.t_lo, 3);
      EXPECT_EQ(found.t_hi, 3);
      EXPECT_GT(found.normal.x(), 0.7);
    }
}

TEST(Impact, at_a_time_that_is_no_number_is_no_hit) {
  const double infinity = std::numeric_limits<double>::infinity();
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  const auto comes = [&](double speed) {
    return first_impact(cube, rest, cube, at(4, 0, 0, {-speed, 0, 0}), infinity);
  };
  EXPECT_EQ(comes(1e-300).status, ImpactStatus::hit);
  EXPECT_NEAR(comes(1e-300).t_lo, 2e300, 1e291);
  EXPECT_NE(comes(1e-310).status, ImpactStatus::hit);
}

/// A distance that did not converge has the value 0, which counted as touching: balls 1e200 from
/// each other were `inside` of each other, and one next to an infinite one was hit in the end.
TEST(Impact, is_given_up_where_the_distance_is_unknown) {
  const ContactShape infinite{Shape(Sphere{std::numeric_limits<double>::infinity()})};
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  for (const double apart : {1e155, 1e200, 1e307})
    for (const Vec3<double>& turn : {Vec3<double>(0, 0, 0), Vec3<double>(0, 1, 0)}) {
      const Impact impact = first_impact(ball, rest, ball, at(apart, 0, 0, {0, 0, 0}, turn), 1);
      EXPECT_EQ(impact.status, ImpactStatus::undecided) << apart;
      EXPECT_EQ(impact.t_lo, 0) << apart;
    }
  EXPECT_EQ(first_impact(infinite, rest, ball, at(4, 0, 0, {0, 0, 0}), 1).status,
            ImpactStatus::undecided);
  EXPECT_EQ(first_impact(ball, rest, ball, at(1e153, 0, 0, {0, 0, 0}), 1).status,
            ImpactStatus::miss);
}

/// Distances end where their squares are no numbers, and what is unknown has the value 0.
TEST(Impact, of_bodies_that_part_beyond_all_distances_is_not_told) {
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  for (const double speed : {1e160, 1e200, 1e250})
    for (const ContactShape* body : {&ball, &cube}) {
      const RigidMotion parts = at(5, 0, 0, {speed, 0, 0}, {0, 1, 0});
      const Impact found = first_impact(*body, rest, *body, parts, 1e6);
      EXPECT_EQ(found.status, ImpactStatus::undecided) << speed;
      EXPECT_GT(found.t_lo, 0) << speed;
      EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity()) << speed;
    }
}

/// Bodies come near enough to be touching a little before they meet.
TEST(Impact, is_never_after_the_time_that_was_asked_for) {
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  const ContactShape cylinder{Shape(Cylinder{1, 1})};
  ImpactOptions coarse;
  coarse.touching = 1e-3;
  int hits = 0;
  for (const Vec3<double>& turn : {Vec3<double>(0, 0, 0), Vec3<double>(0, 0, 1e-9)})
    for (const ContactShape* body : {&ball, &cube, &cylinder})
      for (int i = 0; i < 20; ++i) {
        const double t_max = 3 - i * 2e-4;  // the bodies meet at 3
        const Impact found =
            first_impact(*body, rest, *body, at(5, 0, 0, {-1, 0, 0}, turn), t_max, coarse);
        EXPECT_LE(found.t_lo, t_max);
        hits += found.status == ImpactStatus::hit;
      }
  EXPECT_GE(hits, 6);
}

/// The length of 1e-165 is no square root of its square, 0: such turns were none.
TEST(Impact, slow_and_fast_turns_are_turns) {
  const ContactShape rod{Shape(Capsule{0.1, 5})};
  const Impact ordinary =
      first_impact(rod, at(0, 0, 0, {0, 0, 0}, {0, 1, 0}), ball, at(4, 0, 0, {0, 0, 0}), 3);
  ASSERT_EQ(ordinary.status, ImpactStatus::hit);
  for (const double turn : {1e-300, 1e-170, 1e-165, 1e-160, 1e155, 1e170, 1e300}) {
    const Impact impact = first_impact(rod, at(0, 0, 0, {0, 0, 0}, {0, turn, 0}), ball,
                                       at(4, 0, 0, {0, 0, 0}), 3 / turn);
    ASSERT_EQ(impact.status, ImpactStatus::hit) << turn;
    EXPECT_NEAR(impact.t_lo * turn, ordinary.t_lo, 1e-9) << turn;
    EXPECT_NEAR(impact.t_hi * turn, ordinary.t_hi, 1e-9) << turn;
  }
}

}  // namespace
}  // namespace minkray::testing
