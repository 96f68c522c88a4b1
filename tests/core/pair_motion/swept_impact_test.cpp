// SPDX-License-Identifier: MIT
// Times of impact of bodies that do not turn, which are found in one go, compared with those of
// the steps that turning bodies need.
#include <gtest/gtest.h>

#include <array>

#include "core/pair_motion/impact.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

struct Moving {
  Body a, b;
  RigidMotion of_a, of_b;
  double t_max;

  double size() const { return size_of(a, b); }
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

/// Description of an error in the reported first contact.
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
  const ContactShape cube(Shape(Box{{0.5, 0.5, 0.5}})), plate(Shape(Box{{5, 5, 0.25}}));
  const Mat3<double> on_diagonal =
      Eigen::Quaterniond::FromTwoVectors(Vec3<double>(1, 1, 1), Vec3<double>(0, 0, -1))
          .toRotationMatrix();
  const RigidMotion still{{}},
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
  const ContactShape ball(Shape(Sphere{1}));
  const RigidMotion still{{}},
      passing{{Mat3<double>::Identity(), Vec3<double>(-5, 3, 0)}, Vec3<double>(1, 0, 0)};
  const Impact found = first_impact(ball, still, ball, passing, 5);
  ASSERT_EQ(found.status, ImpactStatus::miss);
  EXPECT_NEAR(found.distance, 1, 1e-14);
  EXPECT_NEAR(found.point_a.y(), 1, 1e-14);
  ImpactOptions options;
  options.points_of_misses = false;
  const Impact bare = first_impact(ball, still, ball, passing, 5, options);
  EXPECT_EQ(bare.steps, 0);
  EXPECT_EQ(bare.distance, std::numeric_limits<double>::infinity());
}

/// Squares of speeds of 1e155 are infinite, and those of 1e-162 have no digits: balls passed by
/// each other on the way that led to their middles.
TEST(SweptImpact, does_not_depend_on_how_fast_the_two_are) {
  const ContactShape ball(Shape(Sphere{1})), box(Shape(Box{{1, 1, 1}})),
      cylinder(Shape(Cylinder{1, 1})), ellipsoid(Shape(Ellipsoid{{1, 0.9, 0.8}})),
      rod(Shape(Capsule{1, 5}));
  const auto at = [](double x, double speed) {
    return RigidMotion{shifted_by(x, 0, 0), Vec3<double>(speed, 0, 0)};
  };
  for (const ContactShape& shape : {ball, box, cylinder, ellipsoid, rod})
    for (const double speed :
         {1e-320, 1e-300, 1e-170, 2.5e-162, 1.6e-162, 1e-154, 1e154, 1e155, 1e300}) {
      const double t_max = std::min(100 / speed, 1e308);
      const Impact met = first_impact(shape, at(0, 0), shape, at(10, -speed), t_max);
      if (speed * t_max > 8) {
        ASSERT_EQ(met.status, ImpactStatus::hit) << speed;
        // A speed of 1e-320 is a number of four digits, and so is the time: relative to it.
        EXPECT_LE(met.t_lo * speed, 8 * (1 + 1e-12)) << speed;
        EXPECT_GE(met.t_hi * speed, 8 * (1 - 1e-12)) << speed;
        EXPECT_LE((met.t_hi - met.t_lo) * speed, 1e-9) << speed;
      } else {
        ASSERT_EQ(met.status, ImpactStatus::miss) << speed;
      }
      const Impact parted = first_impact(shape, at(0, 0), shape, at(10, speed), t_max);
      ASSERT_EQ(parted.status, ImpactStatus::miss) << speed;
      EXPECT_NEAR(parted.normal.x(), 1, 1e-12) << speed;
    }
  // At t_max it is where no distance is known; the result is a miss all the same.
  const Impact gone = first_impact(ball, at(0, 0), ball, at(10, 1e300), 1);
  EXPECT_EQ(gone.status, ImpactStatus::miss);
  EXPECT_NEAR(gone.normal.x(), 1, 1e-12);
  EXPECT_FALSE(std::isfinite(gone.distance));
}

/// Rounding suggests that a body that comes straight at the other from 1e18 sizes away passes by
/// at a hundred sizes: that was reported as a miss.
TEST(SweptImpact, what_comes_straight_at_the_other_from_far_away_is_no_miss) {
  const std::array<Shape, 5> shapes = {Sphere{1}, Box{{1, 1, 1}}, Cone{1, 1}, Cylinder{1, 0.7},
                                       Ellipsoid{{1, 0.7, 0.9}}};
  RandomShapes random(7);
  for (const double far : {1e3, 1e12, 1e18, 1e100, 1e200})
    for (const Shape& a : shapes)
      for (const Shape& b : shapes) {
        // Distances that are no numbers are searched for long.
        if (far > 1e150 && &b != &shapes.front()) continue;
        const Vec3<double> x = far * random.direction();
        const RigidMotion still{{}}, coming{{Mat3<double>::Identity(), x}, -x};
        const ImpactStatus status =
            first_impact(ContactShape(a), still, ContactShape(b), coming, 2).status;
        EXPECT_TRUE(status == ImpactStatus::hit ||
                    (far > 1e15 && status == ImpactStatus::undecided))
            << far;
      }
}

/// Repeats the motion in a time that is 2^power times as short.
Moving in_other_time(Moving pair, int power) {
  const auto scaled = [power](const Vec3<double>& v) -> Vec3<double> {
    return v.unaryExpr([power](double x) { return std::ldexp(x, power); });
  };
  for (RigidMotion* motion : {&pair.of_a, &pair.of_b}) {
    motion->velocity = scaled(motion->velocity);
    motion->angular_velocity = scaled(motion->angular_velocity);
  }
  pair.t_max = std::ldexp(pair.t_max, -power);
  return pair;
}

/// All of it but lengths of velocities is the same to the last bit: of those whose squares are no
/// ordinary numbers the last bits may be others.
TEST(SweptImpact, is_decided_at_the_end_of_a_long_way) {
  struct Row {
    Shape shape;
    long double reach;  // of the middles, along x, when y and z differ by the amounts below
  };
  constexpr double y = 0.375, z = 0.25;
  const long double of_balls = sqrtl(4.0L - y * y - z * z), of_rims = sqrtl(4.0L - y * y);
  const std::vector<Row> rows = {{Sphere{1}, of_balls},
                                 {Box{{1, 1, 1}}, 2},
                                 {Capsule{1, 1}, of_rims},
                                 {Cylinder{1, 1}, of_rims},
                                 {Rounded{0.5, Shape(Box{{0.5, 1, 1}})}, 2}};
  for (const double far : {3e3, 1e5, 1e7, 1e12})
    for (const Row& row : rows) {
      SCOPED_TRACE(far);
      const ContactShape body(row.shape);
      RigidMotion a, b;
      a.velocity = {0.75, 1, 0};
      b.velocity = {-0.25, 1, 0};
      b.pose.translation = {far, y, z};
      const long double truth = far - row.reach;
      const Impact hit = first_impact(body, a, body, b, 2 * far);
      ASSERT_EQ(hit.status, ImpactStatus::hit);
      EXPECT_LE(hit.t_lo, truth);
      EXPECT_GE(hit.t_hi, truth);
      EXPECT_LE(hit.t_hi - hit.t_lo, 4e-10 + 4 * std::numeric_limits<double>::epsilon() * far);
      EXPECT_EQ(first_impact(body, a, body, b, far - 4).status, ImpactStatus::miss);
      b.pose.translation.y() = 3.0001;
      EXPECT_EQ(first_impact(body, a, body, b, 2 * far).status, ImpactStatus::miss);
    }
}

TEST(SweptImpact, another_unit_of_time_scales_the_times_and_nothing_else) {
  RandomShapes random(32);
  std::array<int, 4> statuses = {};
  const auto impact_of = [](const Moving& pair) {
    return first_impact(pair.a.ready, pair.of_a, pair.b.ready, pair.of_b, pair.t_max);
  };
  constexpr int pairs = 2 * kinds_of_bodies * kinds_of_bodies;
  for (int k = 0; k < pairs; ++k) {
    Moving pair = moving(k / 2, random);
    const bool is_turning = k % 2 == 1;
    if (is_turning) {
      pair.of_a.angular_velocity = random.in(0, 2) * random.direction();
      pair.of_b.angular_velocity = random.in(0, 2) * random.direction();
    }
    const Impact once = impact_of(pair);
    ++statuses[static_cast<std::size_t>(once.status)];
    for (const int power : {-900, -500, -300, -100, 100, 300, 500, 900}) {
      const Impact other = impact_of(in_other_time(pair, power));
      ASSERT_EQ(other.status, once.status) << "pair " << k << ", 2^" << power;
      const double t_lo = std::ldexp(other.t_lo, power), t_hi = std::ldexp(other.t_hi, power);
      if (std::abs(power) < 400 || (!is_turning && once.steps == 0)) {
        ASSERT_EQ(t_lo, once.t_lo) << "pair " << k << ", 2^" << power;
        ASSERT_EQ(t_hi, once.t_hi) << "pair " << k << ", 2^" << power;
        ASSERT_EQ(other.normal, once.normal) << "pair " << k << ", 2^" << power;
      } else if (once.status == ImpactStatus::hit) {
        const double near = 1e-9 * pair.size() / pair.speed();
        ASSERT_LE(t_lo, once.t_hi + near) << "pair " << k << ", 2^" << power;
        ASSERT_GE(t_hi, once.t_lo - near) << "pair " << k << ", 2^" << power;
      }
    }
  }
  EXPECT_GT(statuses[static_cast<std::size_t>(ImpactStatus::hit)], 3 * pairs / 10);
  EXPECT_GT(statuses[static_cast<std::size_t>(ImpactStatus::miss)], pairs / 10);
  EXPECT_EQ(statuses[static_cast<std::size_t>(ImpactStatus::undecided)], 0);
}

}  // namespace
}  // namespace minkray::testing
