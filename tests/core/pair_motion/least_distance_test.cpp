// SPDX-License-Identifier: MIT
// Least distances of motions that are known in closed form, and how many distances they take.
#include "core/pair_motion/least_distance.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/core/pair_distance/random_bodies.h"

namespace minkray {
namespace {

using testing::RandomShapes;
using Path = std::function<Vec3<double>(double)>;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

SignedDistance exactly(double distance, const Vec3<double>& normal) {
  SignedDistance found;
  found.value = found.lower = found.upper = distance;
  found.normal = normal;
  return found;
}

/// A ball around the origin, and a point on a path.
class PassingPoint : public MovingPair {
 public:
  PassingPoint(double radius, Path path, double fastest, double bend)
      : radius_(radius), path_(std::move(path)) {
    size = radius;
    speed = fastest;
    acceleration = bend;
  }
  SignedDistance at(double s, double at_most) const override {
    most_asked = std::max(most_asked, at_most);
    const Vec3<double> c = path_(s);
    return exactly(c.norm() - radius_, c.normalized());
  }
  double gap(const Vec3<double>& n, double s) const override { return n.dot(path_(s)) - radius_; }

  mutable double most_asked = -infinity;

 private:
  double radius_;
  Path path_;
};

LeastDistanceOptions as_near_as(double gap) {
  LeastDistanceOptions options;
  options.gap = gap;
  return options;
}

TEST(LeastDistance, of_a_point_that_passes_a_ball_is_where_the_path_is_nearest) {
  for (const double nearest : {0.375, 0.0, 1.0}) {
    const Path path = [&](double s) { return Vec3<double>(4 * (s - nearest), 2, 0); };
    const PassingPoint pair(0.5, path, 4, 0);
    const LeastDistance found = least_distance(pair, as_near_as(1e-9));
    EXPECT_TRUE(found.is_settled);
    EXPECT_LE(found.lower, 1.5 + 4 * eps);
    EXPECT_GE(found.upper, 1.5 - 4 * eps);
    EXPECT_LE(found.upper - found.lower, 1e-9);
    EXPECT_NEAR(found.s, nearest, 1e-4);
    EXPECT_EQ(found.there.upper, found.upper);
    EXPECT_NEAR(found.there.normal.y(), 1, 1e-8);
    // Planes give bounds to the square of the steps: bounds of speed alone would need millions.
    EXPECT_LE(found.distances, 8) << nearest;
  }
}

TEST(LeastDistance, of_a_bent_path_takes_few_distances_as_well) {
  // A circle of radius 1 around a place 3 away: the nearest is 2 from the origin, at s = 0.5.
  const Path path = [](double s) {
    const double turn = 3 * (s - 0.5);
    return Vec3<double>(3 - std::cos(turn), std::sin(turn), 0);
  };
  const LeastDistance found = least_distance(PassingPoint(0.5, path, 3, 9), as_near_as(1e-8));
  EXPECT_TRUE(found.is_settled);
  EXPECT_LE(found.lower, 1.5 + 4 * eps);
  EXPECT_GE(found.upper, 1.5 - 4 * eps);
  EXPECT_LE(found.upper - found.lower, 1e-8);
  EXPECT_LE(found.distances, 40);
}

TEST(LeastDistance, is_near_enough_relative_to_itself) {
  const Path path = [](double s) { return Vec3<double>(4 * s - 1, 1000, 0); };
  LeastDistanceOptions options;
  options.relative_gap = 1e-5;
  const LeastDistance found = least_distance(PassingPoint(0.5, path, 4, 0), options);
  EXPECT_TRUE(found.is_settled);
  EXPECT_LE(found.distances, 3);
  EXPECT_LE(found.upper - found.lower, 999.5e-5);
}

TEST(LeastDistance, asks_for_no_distance_beyond_what_is_enough) {
  const Path path = [](double s) { return Vec3<double>(4 * s - 1, 100, 0); };
  const PassingPoint pair(0.5, path, 4, 0);
  LeastDistanceOptions options = as_near_as(1e-9);
  options.enough = 2;
  const LeastDistance found = least_distance(pair, options);
  EXPECT_TRUE(found.is_settled);
  EXPECT_GE(found.lower, 2);
  EXPECT_LE(found.distances, 2);
  EXPECT_LE(pair.most_asked, 2);
}

/// A point that goes through a cube of half edge 1, from one of its sides to the other.
class PointInCube : public MovingPair {
 public:
  PointInCube() { size = speed = 1; }
  SignedDistance at(double s, double) const override {
    const double x = s - 0.5;
    return exactly(std::abs(x) - 1, {std::copysign(1.0, x), 0, 0});
  }
  double gap(const Vec3<double>& n, double s) const override {
    return n.x() * (s - 0.5) - n.cwiseAbs().sum();
  }
};

TEST(LeastDistance, is_not_bounded_by_two_normals_that_cancel) {
  const LeastDistance found = least_distance(PointInCube(), as_near_as(1e-6));
  EXPECT_TRUE(found.is_settled);
  EXPECT_LE(found.lower, -1);
  EXPECT_EQ(found.upper, -1);
  EXPECT_EQ(found.s, 0.5);
}

/// Their distance is 1, but of one time only a lower bound is known.
class UnknownForAMoment : public MovingPair {
 public:
  explicit UnknownForAMoment(double moment) : moment_(moment) {
    size = 1;
    speed = 4;
  }
  SignedDistance at(double s, double) const override {
    SignedDistance found = exactly(1, Vec3<double>::UnitX());
    if (s == moment_) found.lower = -1;
    return found;
  }
  double gap(const Vec3<double>&, double) const override { return -infinity; }

 private:
  double moment_;
};

TEST(LeastDistance, that_is_not_known_at_one_moment_is_settled_by_none_around_it) {
  for (const double moment : {0.5, 0.25, 0.75}) {
    const LeastDistance found = least_distance(UnknownForAMoment(moment), as_near_as(0.25));
    EXPECT_FALSE(found.is_settled);
    EXPECT_LE(found.lower, 0);
    EXPECT_EQ(found.upper, 1);
    // The times next to it are halved until no number is between two of them.
    EXPECT_LE(found.distances, 120) << moment;
    EXPECT_GE(found.distances, 100);
  }
}

/// Approaches as fast as it can, and planes are known at the beginning only.
class StraightOn : public MovingPair {
 public:
  StraightOn() { size = speed = 1; }
  SignedDistance at(double s, double) const override {
    return exactly(3 - s, Vec3<double>::UnitX());
  }
  double gap(const Vec3<double>&, double s) const override { return s > 0 ? -1e9 : 3; }
};

TEST(LeastDistance, is_known_by_the_speed_where_planes_tell_nothing) {
  const LeastDistance found = least_distance(StraightOn(), as_near_as(1e-12));
  EXPECT_TRUE(found.is_settled);
  EXPECT_EQ(found.lower, 2);
  EXPECT_EQ(found.distances, 2);
}

/// Approaches at one speed, by numbers that subtract without rounding.
class Nearing : public MovingPair {
 public:
  Nearing(double from, double to) : from_(from) { size = 1, speed = from - to; }
  SignedDistance at(double s, double) const override {
    return exactly(from_ - s * speed, Vec3<double>::UnitX());
  }
  double gap(const Vec3<double>&, double) const override { return -infinity; }

 private:
  double from_;
};

TEST(LeastDistance, has_no_lower_bound_above_the_upper_one_by_rounding) {
  // The sum of the two is a tie, which rounds up.
  const LeastDistance found = least_distance(Nearing(1.5 + 3 * eps, 0.75), as_near_as(1e-12));
  EXPECT_TRUE(found.is_settled);
  EXPECT_EQ(found.distances, 2);
  EXPECT_EQ(found.upper, 0.75);
  EXPECT_EQ(found.lower, 0.75);
}

TEST(LeastDistance, that_was_not_looked_for_is_bounded_by_nothing) {
  const LeastDistance found;
  EXPECT_EQ(found.lower, -infinity);
  EXPECT_EQ(found.upper, infinity);
  EXPECT_FALSE(found.is_settled);
}

TEST(LeastDistance, that_is_left_unsettled_has_bounds_that_hold) {
  const Path path = [](double s) { return Vec3<double>(4 * s - 1.4, 2, 0); };
  LeastDistanceOptions options = as_near_as(1e-12);
  options.max_distances = 4;
  const LeastDistance found = least_distance(PassingPoint(0.5, path, 4, 0), options);
  EXPECT_FALSE(found.is_settled);
  EXPECT_LE(found.lower, 1.5);
  EXPECT_GE(found.upper, 1.5);
  EXPECT_LE(found.distances, 5);
}

/// Gap between planes of two balls with cores of a point and of a box along n.
long double exact_gap(double radius_a, const Affine<double>& pose_a, const Vec3<double>& half,
                      double radius_b, const Affine<double>& pose_b, const Vec3<double>& n) {
  using Long = long double;
  const Vec3<Long> along = n.cast<Long>(),
                   between = pose_b.translation.cast<Long>() - pose_a.translation.cast<Long>();
  const Vec3<Long> in_b = pose_b.linear.cast<Long>().transpose() * along;
  return along.dot(between) - radius_a - radius_b - in_b.cwiseAbs().dot(half.cast<Long>());
}

TEST(GapAlong, is_what_planes_leave_less_a_little_for_rounding) {
  RandomShapes random(9);
  const Vec3<double> half{0.25, 0.5, 1};
  for (const double radius : {0.0, 0.5, 1e6})
    for (const double away : {0.0, 3.0, 1e6})
      for (int k = 0; k < 300; ++k) {
        const Affine<double> pose_a{random.turn(), random.direction()};
        const Affine<double> pose_b{random.turn(), pose_a.translation + away * random.direction()};
        const ContactShape a{Shape(Sphere{radius + 0.5})};
        const ContactShape b{radius > 0 ? Shape(Rounded{radius, Nested(Shape(Box{half}))})
                                        : Shape(Box{half})};
        const Vec3<double> n = random.direction().normalized();
        const long double exact =
            exact_gap(radius + 0.5, pose_a, half, radius, pose_b, n) / n.cast<long double>().norm();
        const double gap = gap_along(a, pose_a, b, pose_b, n);
        const double sizes = 2 * radius + 2 + away;
        ASSERT_LE(gap, exact) << radius << " " << away << " " << k;
        ASSERT_GE(gap, exact - 40 * eps * sizes) << radius << " " << away << " " << k;
      }
}

}  // namespace
}  // namespace minkray
