// SPDX-License-Identifier: MIT
// Capsules and boxes that move and turn at random, and when they first touch by dense sampling and
// bisection of closed forms in long double: which shares nothing with the solvers.
#pragma once

#include <functional>
#include <string>

#include "core/pair_motion/impact.h"
#include "tests/core/pair_distance/random_numbers.h"

namespace minkray::testing {

using Long = long double;

inline Affine<Long> pose_at(const RigidMotion& motion, Long time) {
  Affine<Long> pose = motion.pose.cast<Long>();
  pose.translation += time * motion.velocity.cast<Long>();
  const Vec3<Long> omega = motion.angular_velocity.cast<Long>();
  const Long speed = omega.norm();
  if (speed > 0)
    pose.linear =
        Eigen::AngleAxis<Long>(time * speed, omega / speed).toRotationMatrix() * pose.linear;
  return pose;
}

inline Long from_point_to_segment(const Vec3<Long>& p, const Vec3<Long>& a, const Vec3<Long>& b) {
  const Vec3<Long> e = b - a;
  const Long t = std::clamp<Long>((p - a).dot(e) / e.squaredNorm(), 0, 1);
  return (p - a - t * e).norm();
}

inline Long between_segments(const std::array<Vec3<Long>, 2>& a,
                             const std::array<Vec3<Long>, 2>& b) {
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
inline Long gap_of_boxes(const Vec3<double>& half_a, const Affine<Long>& a,
                         const Vec3<double>& half_b, const Affine<Long>& b) {
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

struct MovingPair {
  ContactShape a, b;
  RigidMotion of_a, of_b;
  double t_max;
  std::function<Long(Long)> gap;  ///< negative if they overlap
};

inline void move_at_random(MovingPair& pair, RandomNumbers& random) {
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
inline Long first_contact(const MovingPair& pair, int samples) {
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

struct SeenImpacts {
  int hits = 0, misses = 0, inside = 0;
  double width = 0;
};

/// Description of an error in the reported impact; empty if there is none.
inline std::string impact_complaint(const MovingPair& pair, int samples, SeenImpacts& seen) {
  const Impact impact = first_impact(pair.a, pair.of_a, pair.b, pair.of_b, pair.t_max);
  const Long truth = first_contact(pair, samples);
  const double size = pair.a.ball_radius() + pair.b.ball_radius();
  switch (impact.status) {
    case ImpactStatus::undecided:
      return "undecided";
    case ImpactStatus::miss:
      ++seen.misses;
      return truth < 0 ? "" : "a hit that was missed";
    case ImpactStatus::inside:
      ++seen.inside;
      return truth == 0 ? "" : "inside of each other, which they are not";
    case ImpactStatus::hit:
      break;
  }
  ++seen.hits;
  if (truth >= 0 && !(impact.t_lo <= truth)) return "t_lo is later than the contact";
  // At t_hi they overlap, or are as near as touching is.
  if (!(pair.gap(impact.t_hi) <= 2e-10L * size)) return "apart at t_hi";
  if (!(impact.t_hi >= impact.t_lo)) return "t_hi before t_lo";
  if (!(std::abs(impact.normal.norm() - 1) <= 1e-12)) return "a normal not of unit length";
  if (!((impact.point_b - impact.point_a).norm() <= 2e-10 * size + 1e-14)) return "points apart";
  seen.width = std::max(seen.width, impact.t_hi - impact.t_lo);
  return "";
}

/// Sets `gap` for the pair's motions.
inline void judge_capsules(MovingPair& pair, const Capsule& A, const Capsule& B) {
  pair.gap = [A, B, of_a = pair.of_a, of_b = pair.of_b](Long t) {
    const auto ends = [&](const RigidMotion& motion, double half) {
      const Affine<Long> pose = pose_at(motion, t);
      const Vec3<Long> z(0, 0, half);
      return std::array<Vec3<Long>, 2>{pose(Vec3<Long>(-z)), pose(z)};
    };
    return between_segments(ends(of_a, A.half_height), ends(of_b, B.half_height)) - Long(A.radius) -
           Long(B.radius);
  };
}

inline MovingPair capsules_of(const Capsule& A, const Capsule& B, const RigidMotion& of_a,
                              const RigidMotion& of_b, double t_max) {
  MovingPair pair{ContactShape(Shape(A)), ContactShape(Shape(B)), of_a, of_b, t_max, {}};
  judge_capsules(pair, A, B);
  return pair;
}

inline MovingPair moving_capsules(RandomNumbers& random) {
  const Capsule A{random.in(0.1, 0.5), random.in(0.1, 1)},
      B{random.in(0.1, 0.5), random.in(0.1, 1)};
  MovingPair pair{ContactShape(Shape(A)), ContactShape(Shape(B)), {}, {}, 0, {}};
  move_at_random(pair, random);
  judge_capsules(pair, A, B);
  return pair;
}

inline MovingPair moving_boxes(RandomNumbers& random) {
  const Box A{{random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}},
      B{{random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}};
  MovingPair pair{ContactShape(Shape(A)), ContactShape(Shape(B)), {}, {}, 0, {}};
  move_at_random(pair, random);
  pair.gap = [A, B, of_a = pair.of_a, of_b = pair.of_b](Long t) {
    return gap_of_boxes(A.half_extents, pose_at(of_a, t), B.half_extents, pose_at(of_b, t));
  };
  return pair;
}

}  // namespace minkray::testing
