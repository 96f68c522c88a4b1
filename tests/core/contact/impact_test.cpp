// SPDX-License-Identifier: MIT
// Times of impact of bodies that move and turn, beside dense sampling and bisection in long double
// of closed forms.
#include "core/contact/impact.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace minkray {
namespace {

using Long = long double;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    return Vec3<double>(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Mat3<double> turn() { return rotation_matrix(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)); }

 private:
  std::mt19937 engine_;
};

Affine<Long> pose_at(const RigidMotion& motion, Long time) {
  Affine<Long> pose = motion.pose.cast<Long>();
  pose.translation += time * motion.velocity.cast<Long>();
  const Vec3<Long> omega = motion.angular_velocity.cast<Long>();
  const Long speed = omega.norm();
  if (speed > 0)
    pose.linear =
        Eigen::AngleAxis<Long>(time * speed, omega / speed).toRotationMatrix() * pose.linear;
  return pose;
}

Long from_point_to_segment(const Vec3<Long>& p, const Vec3<Long>& a, const Vec3<Long>& b) {
  const Vec3<Long> e = b - a;
  const Long t = std::clamp<Long>((p - a).dot(e) / e.squaredNorm(), 0, 1);
  return (p - a - t * e).norm();
}

Long between_segments(const std::array<Vec3<Long>, 2>& a, const std::array<Vec3<Long>, 2>& b) {
  Long best = std::min(
      std::min(from_point_to_segment(a[0], b[0], b[1]), from_point_to_segment(a[1], b[0], b[1])),
      std::min(from_point_to_segment(b[0], a[0], a[1]), from_point_to_segment(b[1], a[0], a[1])));
  const Vec3<Long> u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0], n = u.cross(v);
  const Long squared = n.squaredNorm();
  if (!(squared > 0)) return best;
  const Long s = w.cross(v).dot(n) / squared, t = w.cross(u).dot(n) / squared;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
    best = std::min(best, std::abs(w.dot(n)) / std::sqrt(squared));
  return best;
}

/// Two boxes' largest gap over the 15 separating axes: positive if and only if they are apart.
Long gap_of_boxes(const Vec3<double>& half_a, const Affine<Long>& a, const Vec3<double>& half_b,
                  const Affine<Long>& b) {
  const Mat3<Long> R = a.linear.transpose() * b.linear;
  const Vec3<Long> x = a.linear.transpose() * (b.translation - a.translation);
  const auto gap = [&](const Vec3<Long>& n) {
    return (std::abs(n.dot(x)) - half_a.cast<Long>().dot(n.cwiseAbs()) -
            half_b.cast<Long>().dot((R.transpose() * n).cwiseAbs())) /
           n.norm();
  };
  Long best = -1e9L;
  for (int i = 0; i < 3; ++i) {
    best = std::max({best, gap(Vec3<Long>::Unit(i)), gap(R.col(i))});
    for (int j = 0; j < 3; ++j) {
      const Vec3<Long> n = Vec3<Long>::Unit(i).cross(R.col(j));
      if (n.norm() > 1e-9L) best = std::max(best, gap(n));
    }
  }
  return best;
}

struct Pair {
  ContactShape a, b;
  RigidMotion of_a, of_b;
  double t_max;
  std::function<Long(Long)> gap;  ///< its sign says whether they are apart
};

void move_at_random(Pair& pair, Random& random) {
  pair.of_a.pose = {random.turn(), 10 * random.direction()};
  pair.of_b.pose = {random.turn(),
                    pair.of_a.pose.translation + random.in(1.2, 4) * random.direction()};
  pair.of_a.velocity = random.in(0, 1) * random.direction();
  pair.of_b.velocity = pair.of_a.velocity -
                       random.in(0, 2) * (pair.of_b.pose.translation - pair.of_a.pose.translation +
                                          0.8 * random.direction());
  pair.of_a.angular_velocity = random.in(0, 3) * random.direction();
  pair.of_b.angular_velocity = random.in(0, 3) * random.direction();
  pair.t_max = random.in(0.5, 2);
}

/// The first time at which a sample is not apart, by bisection; negative if none is.
Long first_contact(const Pair& pair, int samples) {
  if (pair.gap(0) < 0) return 0;
  for (int i = 1; i <= samples; ++i) {
    Long low = Long(pair.t_max) * (i - 1) / samples, high = Long(pair.t_max) * i / samples;
    if (!(pair.gap(high) < 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const Long middle = (low + high) / 2;
      (pair.gap(middle) < 0 ? high : low) = middle;
    }
    return high;
  }
  return -1;
}

struct Seen {
  int hits = 0, misses = 0, inside = 0;
  double width = 0;
};

void expect_true(const Pair& pair, int samples, Seen& seen) {
  const Impact impact = first_impact(pair.a, pair.of_a, pair.b, pair.of_b, pair.t_max);
  const Long truth = first_contact(pair, samples);
  const double size = pair.a.ball_radius() + pair.b.ball_radius();
  ASSERT_NE(impact.status, ImpactStatus::undecided);
  if (impact.status == ImpactStatus::miss) {
    ++seen.misses;
    ASSERT_LT(truth, 0);
    return;
  }
  if (impact.status == ImpactStatus::inside) {
    ++seen.inside;
    ASSERT_EQ(truth, 0);
    return;
  }
  ++seen.hits;
  if (truth >= 0) {
    ASSERT_LE(impact.t_lo, truth);
  }
  // They are in each other at t_hi, or as near as touching is.
  ASSERT_LE(pair.gap(impact.t_hi), 2e-10L * size);
  ASSERT_GE(impact.t_hi, impact.t_lo);
  seen.width = std::max(seen.width, impact.t_hi - impact.t_lo);
  ASSERT_NEAR(impact.normal.norm(), 1, 1e-12);
  ASSERT_LE((impact.point_b - impact.point_a).norm(), 2e-10 * size + 1e-14);
}

TEST(Impact, of_turning_capsules_is_that_of_dense_samples) {
  Random random(3);
  Seen seen;
  for (int k = 0; k < 3000; ++k) {
    const Capsule<double> A{random.in(0.1, 0.5), random.in(0.1, 1)},
        B{random.in(0.1, 0.5), random.in(0.1, 1)};
    Pair pair{ContactShape(Shape<double>(A)), ContactShape(Shape<double>(B)), {}, {}, 0, {}};
    move_at_random(pair, random);
    pair.gap = [&](Long t) {
      const auto ends = [&](const RigidMotion& motion, double half) {
        const Affine<Long> pose = pose_at(motion, t);
        const Vec3<Long> z(0, 0, half);
        return std::array<Vec3<Long>, 2>{pose(Vec3<Long>(-z)), pose(z)};
      };
      return between_segments(ends(pair.of_a, A.half_height), ends(pair.of_b, B.half_height)) -
             Long(A.radius) - Long(B.radius);
    };
    expect_true(pair, 200, seen);
    if (HasFatalFailure()) FAIL() << k;
  }
  EXPECT_GT(seen.hits, 900);
  EXPECT_GT(seen.misses, 900);
  EXPECT_LT(seen.width, 1e-6);
}

TEST(Impact, of_turning_boxes_is_that_of_dense_samples) {
  Random random(4);
  Seen seen;
  for (int k = 0; k < 2000; ++k) {
    const Box<double> A{{random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}},
        B{{random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}};
    Pair pair{ContactShape(Shape<double>(A)), ContactShape(Shape<double>(B)), {}, {}, 0, {}};
    move_at_random(pair, random);
    pair.gap = [&](Long t) {
      return gap_of_boxes(A.half_extents, pose_at(pair.of_a, t), B.half_extents,
                          pose_at(pair.of_b, t));
    };
    expect_true(pair, 100, seen);
    if (HasFatalFailure()) FAIL() << k;
  }
  EXPECT_GT(seen.hits, 600);
  EXPECT_GT(seen.misses, 300);
  EXPECT_LT(seen.width, 1e-6);
}

const ContactShape cube{Shape<double>(Box<double>{{1, 1, 1}})};

RigidMotion at(double x, double y, double z, const Vec3<double>& velocity,
               const Vec3<double>& angular = Vec3<double>::Zero()) {
  return {{Mat3<double>::Identity(), Vec3<double>(x, y, z)}, velocity, angular};
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

TEST(Impact, what_grazes_is_a_hit_and_what_passes_is_a_miss) {
  const ContactShape ball(Shape<double>(Sphere<double>{1}));
  const RigidMotion rest = at(0, 0, 0, {0, 0, 0});
  const auto pass = [&](double beside) {
    return first_impact(ball, rest, ball, at(-5, beside, 0, {1, 0, 0}), 10).status;
  };
  EXPECT_EQ(pass(2), ImpactStatus::hit);
  EXPECT_EQ(pass(2 - 1e-6), ImpactStatus::hit);
  EXPECT_EQ(pass(2 + 1e-6), ImpactStatus::miss);
}

}  // namespace
}  // namespace minkray
