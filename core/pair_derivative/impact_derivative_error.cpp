// SPDX-License-Identifier: MIT
#include "core/pair_derivative/impact_derivative_error.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Upper bound of the speed of the body's points.
double speed_of(const ContactShape& shape, const RigidMotion& motion) {
  return motion.velocity.norm() +
         motion.angular_velocity.norm() * (shape.ball_radius() + shape.offset());
}

/// Returns the rotation of the body from time 0 to `time`.
Mat3<double> turn_at(const RigidMotion& motion, double time) {
  RigidMotion turning;
  turning.angular_velocity = motion.angular_velocity;
  return turning.at(time).linear;
}

/// Error of a speed due to a turn; 0 for a body that does not turn, even if `error` is infinite.
double by_speed(double speed, double error) {
  return speed > 0 ? speed * error : 0;
}

}  // namespace

PairDerivativeError error_of(const Impact& found) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (found.status == ImpactStatus::miss) return {{nan, nan}, {nan, nan}};
  if (found.status == ImpactStatus::inside) return {{0, 0}, {0, 0}};
  return {};
}

PairDerivativeError error_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found, const PairDerivative& derivative) {
  PairDerivativeError error = error_of(found);
  if (found.status != ImpactStatus::hit) return error;
  const double time = found.t_lo, slowness = derivative.b.by_velocity.norm();
  if (derivative.is_ridge || !(slowness > 0) || !std::isfinite(slowness)) return error;

  // Finds the contact at t_lo, and bounds the motion until the bodies certainly touch.
  const Affine<double> pose_a = motion_a.at(time), pose_b = motion_b.at(time);
  const SignedDistance nearest = signed_distance(a, pose_a, b, pose_b, for_derivatives());
  if (nearest.is_unknown() || !std::isfinite(nearest.upper)) return error;
  const CoresInWorld cores(a, pose_a, b, pose_b);
  const double rounding = cores.rounding();
  double later = found.t_hi - time;
  if (!(later > 0) && !(nearest.upper <= 4 * rounding)) return error;
  later += 4 * epsilon * found.t_hi + 8 * rounding * slowness;
  const double spin_a = motion_a.angular_velocity.norm(), spin_b = motion_b.angular_velocity.norm();
  const double speed = speed_of(a, motion_a) + speed_of(b, motion_b),
               spin = std::max(spin_a, spin_b);
  Drift drift;
  drift.way = later * speed +
              8 * epsilon * (time * speed + pose_a.translation.norm() + pose_b.translation.norm());
  if (spin > 0) drift.turn = later * spin + 16 * epsilon * (1 + time * spin);

  // The numerator is the derivative of the gap with respect to twists.
  const Vec3<double> middle = middle_in_world(a, pose_a);
  const double radius_a = a.core().radius, radii = radius_a + b.core().radius;
  CoreContact contact{nearest.normal, nearest.point_a - middle - radius_a * nearest.normal,
                      nearest.point_b - nearest.point_a + radii * nearest.normal};
  sharpen(cores, contact);
  const Vec3<double> origin_a = pose_a.translation - middle, origin_b = pose_b.translation - middle;
  constexpr double not_known = std::numeric_limits<double>::infinity();
  PairDerivativeError of_gap =
      error_of(cores, contact, nearest, not_known, origin_a, origin_b, drift);
  const Vec3<double>& n = contact.normal;
  const Vec3<double> turn_a = turn_at(motion_a, time) * derivative.a.by_turn,
                     turn_b = turn_at(motion_b, time) * derivative.b.by_turn;
  const double of_normal = (derivative.b.by_velocity / slowness - n).norm();
  of_gap.a.by_velocity += of_normal;
  of_gap.b.by_velocity += of_normal;
  of_gap.a.by_turn += (turn_a / slowness + (contact.a - origin_a).cross(n)).norm() + drift.way;
  of_gap.b.by_turn +=
      (turn_b / slowness - (contact.a + contact.c - origin_b).cross(n)).norm() + drift.way;

  // The denominator is the closing speed, n.(v_a - v_b) + w_a.(r_a x n) - w_b.(r_b x n).
  const double of_speed = of_gap.a.by_velocity * (motion_a.velocity - motion_b.velocity).norm() +
                          by_speed(spin_a, of_gap.a.by_turn) + by_speed(spin_b, of_gap.b.by_turn) +
                          16 * epsilon * speed;
  const double least = 1 / slowness - of_speed;
  if (!(least > 0)) return error;
  const auto quotient = [&](double of_numerator, double length) {
    return (of_numerator + length * of_speed) / least + 16 * epsilon * length;
  };
  error.a = {quotient(of_gap.a.by_velocity, slowness),
             quotient(of_gap.a.by_turn, turn_a.norm()) + turn_a.norm() * drift.turn};
  error.b = {quotient(of_gap.b.by_velocity, slowness),
             quotient(of_gap.b.by_turn, turn_b.norm()) + turn_b.norm() * drift.turn};
  return error;
}

}  // namespace minkray
