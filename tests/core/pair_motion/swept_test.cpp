// SPDX-License-Identifier: MIT
// Swept bodies contain the motion, and least distances are those of dense samples: judged by the
// shapes' support functions and by closed forms in long double.
#include "core/pair_motion/swept.h"

#include <gtest/gtest.h>

#include "core/pair_distance/half_space_distance.h"
#include "core/pair_motion/impact.h"
#include "core/pair_motion/least_distance.h"
#include "tests/core/pair_distance/random_bodies.h"

namespace minkray {
namespace {

using testing::kinds_of_bodies;
using testing::random_shape;
using testing::RandomShapes;
using Long = long double;

/// Distance of a point beyond the support planes of a shape, judged by some directions.
double outside(const Shape& shape, const Vec3<double>& point, const Vec3<double>& towards,
               RandomShapes& random) {
  double most = -1e300;
  for (int i = 0; i < 6; ++i) {
    Vec3<double> n = i == 0  ? towards
                     : i < 3 ? Vec3<double>(towards + 0.1 * random.direction())
                             : random.direction();
    if (!(n.norm() > 0)) continue;
    n.normalize();
    most = std::max(most, n.dot(point - shape.support(n)));
  }
  return most;
}

/// The ends of a motion that RigidMotion makes in a second.
struct Screw {
  RigidMotion motion;
  Affine<double> from, to;

  explicit Screw(RandomShapes& random, double turn) {
    motion.pose = {random.turn(), 3 * random.direction()};
    motion.velocity = random.in(0, 2) * random.direction();
    motion.angular_velocity = turn * random.direction();
    from = motion.at(0);
    to = motion.at(1);
  }
};

TEST(Swept, no_point_of_a_turning_body_leaves_its_swept_shape) {
  RandomShapes random(5);
  int left_hull = 0;
  for (int k = 0; k < 400; ++k) {
    const Shape shape = random_shape(k % kinds_of_bodies, 1, random);
    const Screw screw(random, random.in(0, 3));
    const Shape holds = swept(shape, screw.from, screw.to);
    const Shape hull = swept(shape, screw.from, screw.to, 0);
    bool has_left = false;
    for (int i = 0; i < 200; ++i) {
      const double s = random.in(0, 1);
      const Vec3<double> p = shape.support(random.direction());
      const Vec3<double> there = screw.motion.at(s)(p);
      // Away from the straight line between its ends it is nearest to leaving.
      const Vec3<double> away = there - ((1 - s) * screw.from(p) + s * screw.to(p));
      ASSERT_LE(outside(holds, there, away, random), 1e-12) << k;
      has_left |= outside(hull, there, away, random) > 1e-3;
    }
    left_hull += has_left;
  }
  // The hull of the two ends alone does not hold them.
  EXPECT_GT(left_hull, 100);
}

TEST(Swept, the_least_distance_from_an_axis_that_holds_a_shape_is_found) {
  RandomShapes random(6);
  for (int k = 0; k < 300; ++k) {
    const Shape shape = random_shape(k % kinds_of_bodies, 1, random);
    const Vec3<double> axis = random.direction();
    const double most = distance_from_axis(shape, axis);
    double seen = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3<double> p = shape.support(random.direction());
      seen = std::max(seen, (p - p.dot(axis) * axis).norm());
    }
    ASSERT_GE(most, seen * (1 - 1e-14)) << k;
  }
  EXPECT_NEAR(distance_from_axis(Cylinder{0.5, 2}, {0, 0, 1}), 0.5, 0.005);
}

/// Two capsules that move like screws, with bounds of their speed and acceleration.
class MovingCapsules : public MovingPair {
 public:
  explicit MovingCapsules(RandomShapes& random)
      : capsule_a_{random.in(0.05, 0.3), random.in(0.1, 1)},
        capsule_b_{random.in(0.05, 0.3), random.in(0.1, 1)},
        a_{Shape(capsule_a_)},
        b_{Shape(capsule_b_)},
        of_a_(random, random.in(0, 3)),
        of_b_(random, random.in(0, 3)) {
    of_b_.motion.pose.translation =
        of_a_.motion.pose.translation + random.in(0.5, 3) * random.direction();
    for (const auto& [capsule, screw] : {std::pair{&capsule_a_, &of_a_}, {&capsule_b_, &of_b_}}) {
      const double turn = screw->motion.angular_velocity.norm(),
                   reach = capsule->radius + capsule->half_height;
      speed += screw->motion.velocity.norm() + turn * reach;
      acceleration += turn * turn * reach;
      size += reach;
    }
  }

  SignedDistance at(double s, double at_most) const override {
    SignedDistanceOptions options;
    options.at_most = at_most;
    return signed_distance(a_, of_a_.motion.at(s), b_, of_b_.motion.at(s), options);
  }
  double gap(const Vec3<double>& n, double s) const override {
    return gap_along(a_, of_a_.motion.at(s), b_, of_b_.motion.at(s), n);
  }

  /// Computed from the ends and the lines of the two segments, in long double.
  Long true_distance(double s) const {
    const auto ends = [&](const Screw& screw, const Capsule& capsule) {
      const Affine<Long> pose = screw.motion.at(s).cast<Long>();
      const Vec3<Long> z(0, 0, capsule.half_height);
      return std::array<Vec3<Long>, 2>{pose(Vec3<Long>(-z)), pose(z)};
    };
    const auto a = ends(of_a_, capsule_a_), b = ends(of_b_, capsule_b_);
    const auto to_segment = [](const Vec3<Long>& p, const std::array<Vec3<Long>, 2>& of) {
      const Vec3<Long> e = of[1] - of[0];
      const Long t = std::clamp<Long>((p - of[0]).dot(e) / e.squaredNorm(), 0, 1);
      return (p - of[0] - t * e).norm();
    };
    Long best = std::min(
        {to_segment(a[0], b), to_segment(a[1], b), to_segment(b[0], a), to_segment(b[1], a)});
    const Vec3<Long> u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0], n = u.cross(v);
    const Long squared = n.squaredNorm();
    if (squared > 0) {
      const Long s_a = w.cross(v).dot(n) / squared, s_b = w.cross(u).dot(n) / squared;
      if (s_a >= 0 && s_a <= 1 && s_b >= 0 && s_b <= 1)
        best = std::min(best, std::abs(w.dot(n)) / std::sqrt(squared));
    }
    return best - Long(capsule_a_.radius) - Long(capsule_b_.radius);
  }

 private:
  Capsule capsule_a_, capsule_b_;
  ContactShape a_, b_;
  Screw of_a_, of_b_;
};

TEST(LeastDistance, of_moving_capsules_is_below_all_samples_and_near_the_least) {
  RandomShapes random(7);
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 200; ++k) {
    const MovingCapsules pair(random);
    LeastDistanceOptions options;
    options.gap = k % 2 == 0 ? 1e-3 : 1e-6;
    const LeastDistance found = least_distance(pair, options);
    ASSERT_TRUE(found.is_settled) << k;
    Long least = 1e30L;
    for (int i = 0; i <= 2000; ++i) least = std::min(least, pair.true_distance(i / 2000.0));
    ASSERT_LE(found.lower, least) << k;
    ASSERT_LE(found.upper - found.lower, options.gap) << k;
    ASSERT_LE(found.upper, least + options.gap) << k;
    ASSERT_NEAR(static_cast<double>(pair.true_distance(found.s)), found.upper, 1e-12) << k;
    (least > 0 ? apart : overlapping) += 1;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(overlapping, 3);
}

TEST(LeastDistance, ends_early_where_it_is_known_to_be_enough) {
  RandomShapes random(8);
  int early = 0;
  for (int k = 0; k < 100; ++k) {
    const MovingCapsules pair(random);
    LeastDistanceOptions options;
    options.gap = 1e-9;
    options.enough = 0.01;
    const LeastDistance found = least_distance(pair, options);
    Long least = 1e30L;
    for (int i = 0; i <= 500; ++i) least = std::min(least, pair.true_distance(i / 500.0));
    ASSERT_LE(found.lower, least) << k;
    if (least > 0.02L) {
      ++early;
      ASSERT_GE(found.lower, 0.01 - options.gap) << k;
      ASSERT_LT(found.distances, 300) << k;
    }
  }
  EXPECT_GT(early, 30);
}

TEST(HalfSpaceDistance, of_all_kinds_of_shapes_is_their_lowest_point) {
  RandomShapes random(9);
  for (int k = 0; k < 500; ++k) {
    const testing::Body body(random_shape(k % kinds_of_bodies, 1, random),
                             {random.turn(), 2 * random.direction()});
    const Vec3<double> n = random.direction();
    const double offset = random.in(-1, 1);
    const SignedDistance found = distance_to_half_space(n, offset, body.ready, body.pose);
    const Long truth = -body.support_function(-n, {0, 0, 0}) - Long(offset);
    ASSERT_LE(found.lower, truth) << k;
    ASSERT_GE(found.upper, truth) << k;
    ASSERT_LE(found.upper - found.lower, 1e-13) << k;
    ASSERT_NEAR(n.dot(found.point_a), offset, 1e-13) << k;
    ASSERT_NEAR(n.dot(found.point_b), found.value + offset, 1e-13) << k;
  }
}

}  // namespace
}  // namespace minkray
