// SPDX-License-Identifier: MIT
// Bounds of the errors of times of impact's derivatives hold: compared with differences of the
// times at which closed forms in long double are zero.
#include <gtest/gtest.h>

#include <sstream>
#include "core/pair_derivative/impact_derivative_error.h"
#include "tests/core/pair_motion/moving_pairs.h"
#include "tests/support/number_of_cases.h"

namespace minkray::testing {
namespace {

/// Two bodies in motion, and their gap at two poses.
struct JudgedPair {
  ContactShape a, b;
  RigidMotion of_a, of_b;
  std::function<Long(const Affine<Long>&, const Affine<Long>&)> gap;
};

/// A capsule and another one, a ball at a box, or a ball at a rounded box.
JudgedPair moving_pair(int kind, RandomNumbers& random) {
  const Capsule one{random.in(0.1, 0.5), random.in(0.1, 1)};
  const Sphere ball{random.in(0.1, 0.5)};
  const Box box{{random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}};
  MovingPair moving{ContactShape(Shape(one)), ContactShape(Shape(one)), {}, {}, 0, {}};
  move_at_random(moving, random);
  JudgedPair pair{
      ContactShape(Shape(one)), ContactShape(Shape(ball)), moving.of_a, moving.of_b, {}};
  if (kind == 0) {
    const Capsule other{random.in(0.1, 0.5), random.in(0.1, 1)};
    pair.b = ContactShape(Shape(other));
    pair.gap = [one, other](const Affine<Long>& a, const Affine<Long>& b) {
      const auto ends = [](const Affine<Long>& pose, double half) {
        const Vec3<Long> z(0, 0, half);
        return std::array<Vec3<Long>, 2>{pose(Vec3<Long>(-z)), pose(z)};
      };
      return between_segments(ends(a, one.half_height), ends(b, other.half_height)) -
             Long(one.radius) - Long(other.radius);
    };
    return pair;
  }
  const double radius = kind == 1 ? 0 : 0.125;
  pair.a = ContactShape(radius > 0 ? Shape(Rounded{radius, Shape(box)}) : Shape(box));
  pair.gap = [box, radius, ball](const Affine<Long>& a, const Affine<Long>& b) {
    const Vec3<Long> at = a.linear.transpose() * (b.translation - a.translation);
    const Vec3<Long> half = box.half_extents.cast<Long>();
    return (at - at.cwiseMin(half).cwiseMax(-half)).norm() - Long(radius) - Long(ball.radius);
  };
  return pair;
}

/// The first body's pose at time 0 is moved along a twist, or the second one's.
struct OneTwist {
  bool of_a;
  Vec3<Long> velocity, turn;
};

/// Time of the contact near `about`; NaN if there is none.
Long time_of(const JudgedPair& pair, const OneTwist& twist, Long step, Long about, Long reach) {
  const auto pose = [&](const RigidMotion& motion, bool is_twisted, Long time) {
    Affine<Long> at = pose_at(motion, 0);
    if (is_twisted) {
      at.translation += step * twist.velocity;
      const Long angle = twist.turn.norm();
      at.linear =
          Eigen::AngleAxis<Long>(step * angle, twist.turn / angle).toRotationMatrix() * at.linear;
    }
    RigidMotion turning;
    turning.angular_velocity = motion.angular_velocity;
    at.linear = pose_at(turning, time).linear * at.linear;
    at.translation += time * motion.velocity.cast<Long>();
    return at;
  };
  const auto gap = [&](Long time) {
    return pair.gap(pose(pair.of_a, twist.of_a, time), pose(pair.of_b, !twist.of_a, time));
  };
  Long low = about - reach, high = about + reach;
  if (!(gap(low) > 0) || !(gap(high) < 0)) return std::numeric_limits<Long>::quiet_NaN();
  for (int i = 0; i < 70; ++i) {
    const Long middle = (low + high) / 2;
    (gap(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

struct TimeSlope {
  Long value = 0, unsure = std::numeric_limits<Long>::infinity();
};

/// Differences of fourth order by shorter and shorter steps, those that agree best.
TimeSlope time_slope_of(const JudgedPair& pair, const OneTwist& twist, Long about, Long length) {
  const auto central = [&](Long step) {
    const Long reach = 3 * step * length + 1e-7L;
    return (time_of(pair, twist, step, about, reach) - time_of(pair, twist, -step, about, reach)) /
           (2 * step);
  };
  TimeSlope best;
  Long before = std::numeric_limits<Long>::quiet_NaN();
  for (Long step = 1e-3L; step > 0.9e-7L; step /= 10) {
    const Long slope = (4 * central(step / 2) - central(step)) / 3;
    const Long off =
        std::abs(slope - before) + 64 * std::numeric_limits<Long>::epsilon() * 20 * length / step;
    if (off < best.unsure) best = {slope, off};
    before = slope;
  }
  return best;
}

class ImpactDerivativeErrors : public ::testing::TestWithParam<int> {};

TEST_P(ImpactDerivativeErrors, have_bounds) {
  RandomNumbers random(static_cast<unsigned>(71 + GetParam()));
  std::vector<double> bounds;
  int hits = 0, judged = 0;
  const int cases = number_of_cases(600);
  for (int n = 0; n < cases; ++n) {
    JudgedPair pair = moving_pair(GetParam(), random);
    if (n % 3 == 0) pair.of_a.angular_velocity = pair.of_b.angular_velocity = Vec3<double>::Zero();
    const Impact found = first_impact(pair.a, pair.of_a, pair.b, pair.of_b, 2);
    if (found.status != ImpactStatus::hit) continue;
    ++hits;
    const PairDerivative derivative = derivative_of(pair.a, pair.of_a, pair.b, pair.of_b, found);
    const PairDerivativeError error =
        error_of(pair.a, pair.of_a, pair.b, pair.of_b, found, derivative);
    if (derivative.is_ridge) {
      EXPECT_TRUE(std::isinf(error.a.by_velocity)) << n;
      continue;
    }
    for (const bool of_a : {true, false}) {
      const OneTwist twist{of_a, random.direction().cast<Long>(), random.direction().cast<Long>()};
      const TwistDerivative& by = of_a ? derivative.a : derivative.b;
      const TwistError& bound = of_a ? error.a : error.b;
      const Long told =
          by.by_velocity.cast<Long>().dot(twist.velocity) + by.by_turn.cast<Long>().dot(twist.turn);
      const Long length = by.by_velocity.norm() + by.by_turn.norm();
      const double allowed = bound.by_velocity + bound.by_turn;
      bounds.push_back(allowed / static_cast<double>(length));
      const TimeSlope slope = time_slope_of(pair, twist, found.t_lo, length);
      judged += slope.unsure <= allowed ? 1 : 0;
      EXPECT_LE(std::abs(slope.value - told) - 3 * slope.unsure, allowed) << n << " " << of_a;
    }
  }
  EXPECT_GT(hits, cases / 4);
  EXPECT_GT(judged, hits);
  ASSERT_FALSE(bounds.empty());
  std::ranges::sort(bounds);
  std::ostringstream median;
  median << bounds[bounds.size() / 2];
  RecordProperty("median", median.str());
  // The times of bodies that turn are known to 1e-10.
  EXPECT_LT(bounds[bounds.size() / 2], 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ImpactDerivativeErrors, ::testing::Values(0, 1, 2));

TEST(ImpactDerivativeError, is_what_is_known_without_a_contact) {
  const ContactShape ball{Shape(Sphere{1})}, box{Shape(Box{{1, 1, 1}})};
  const auto error_at = [](const ContactShape& a, const ContactShape& b, double x, double speed) {
    RigidMotion of_a, of_b;
    of_b.pose.translation.x() = x;
    of_b.pose.translation.y() = 0.25;
    of_b.velocity.x() = speed;
    const Impact found = first_impact(a, of_a, b, of_b, 10);
    return error_of(a, of_a, b, of_b, found, derivative_of(a, of_a, b, of_b, found));
  };
  EXPECT_LT(error_at(ball, ball, 4, -1).a.by_turn, 1e-12);
  EXPECT_TRUE(std::isnan(error_at(ball, ball, 4, 1).a.by_velocity));
  EXPECT_EQ(error_at(ball, ball, 1, 1).b.by_turn, 0);
  EXPECT_TRUE(std::isinf(error_at(box, box, 4, -1).b.by_velocity));
}

}  // namespace
}  // namespace minkray::testing
