// SPDX-License-Identifier: MIT
#include "core/pair_derivative/pair_derivative.h"

#include <algorithm>
#include <cmath>

#include "core/pair/core_pair.h"
#include "core/pair/flat_part.h"
#include "core/pair_derivative/impact_contact.h"
#include "core/pair_derivative/pair_derivative_sharpen.h"

namespace minkray {
namespace {

constexpr double not_known = std::numeric_limits<double>::infinity();

PairDerivative unknown(bool is_ridge) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3<double> nans(nan, nan, nan);
  return {{nans, nans}, {nans, nans}, is_ridge};
}

/// Largest angle between the computed normal and the true one, for a distance `length` whose bounds
/// are `interval` apart.
double tilt_of(double interval, double length) {
  constexpr double most = 1e-3;
  constexpr double least = 1e-12;  // includes the rounding of a direction rotated to a body's frame
  const double tilt = std::sqrt(2 * interval / length);
  return tilt < most ? std::max(tilt, least) : most;  // `most` for NaN, too
}

bool has_flat_parts(const ShapeCore& core) {
  return core.kind != CoreKind::point && core.kind != CoreKind::ellipsoid;
}

/// True for cores whose support mapping visits all points.
bool is_slow(const ShapeCore& core) {
  return core.kind == CoreKind::hull || core.kind == CoreKind::other;
}

/// Rotates a direction of the world to the frame of the shape's core.
Vec3<double> in_core(const ContactShape& shape, const Mat3<double>& linear, const Vec3<double>& d) {
  const Vec3<double> own = linear.transpose() * d;
  return shape.is_turned() ? Vec3<double>(shape.turn().transpose() * own) : own;
}

/// Heights along the normal of the cores' contact points above their middles, each outwards.
struct ContactHeights {
  double a = unknown_height, b = unknown_height;
};

/// Returns where two bodies with flat parts may touch if moved together along the normal.
ContactRegion touching_region(const ContactShape& a, const Mat3<double>& linear_a,
                              const ContactShape& b, const Mat3<double>& linear_b,
                              const Vec3<double>& normal, double interval, double length,
                              const ContactHeights& heights = {}) {
  const double tilt = tilt_of(interval, length);
  FlatPart of_a, of_b;
  const auto a_is_flat = [&] {
    of_a = flat_part(a.core(), in_core(a, linear_a, normal), tilt, heights.a);
    return of_a.dimension > 0;
  };
  const auto b_is_flat = [&] {
    of_b = flat_part(b.core(), in_core(b, linear_b, -normal), tilt, heights.b);
    return of_b.dimension > 0;
  };
  const bool b_first = is_slow(a.core()) && !is_slow(b.core());
  if (b_first ? !b_is_flat() || !a_is_flat() : !a_is_flat() || !b_is_flat()) return {};
  if (of_a.dimension == 2 && of_b.dimension == 2) return {2};
  const Mat3<double> turn_a = turn_in_world(a, linear_a), turn_b = turn_in_world(b, linear_b);
  if (of_a.dimension == 2) return {1, turn_b * of_b.along};
  if (of_b.dimension == 2) return {1, turn_a * of_a.along};
  // Two edges have one common point, unless they are nearly parallel: the gap then grows by less
  // than the interval of the bounds up to the end of the shorter edge.
  const double sine = (turn_a * of_a.along).cross(turn_b * of_b.along).norm();
  const double shorter = std::min(of_a.length, of_b.length);
  if (sine <= tilt || sine * shorter <= std::sqrt(2 * interval * length))
    return {1, turn_a * of_a.along};
  return {};
}

/// True if any two bodies may touch in more than a point.
bool have_many_points(const ContactShape& a, const Mat3<double>& linear_a, const ContactShape& b,
                      const Mat3<double>& linear_b, const Vec3<double>& normal, double interval,
                      double length, const ContactHeights& heights = {}) {
  return has_flat_parts(a.core()) && has_flat_parts(b.core()) &&
         touching_region(a, linear_a, b, linear_b, normal, interval, length, heights).dimension > 0;
}

/// Largest angle between the normal and other directions of least depth; `not_known` if they may be
/// any. Moves B deeper along the normal by `step` sizes. Then the depth along the normal grows
/// most, so other directions become better.
double tilt_of_depth(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                     const Affine<double>& pose_b, const SignedDistance& found, double step,
                     double tolerance) {
  const double way = step * (a.ball_radius() + b.ball_radius());
  Between deeper = between_middles(a, pose_a, b, pose_b);
  deeper.x -= way * found.normal;
  SignedDistanceOptions how;
  how.tolerance = tolerance;
  const SignedDistance there =
      signed_distance(a, pose_a.linear, b, pose_b.linear, deeper, how, nullptr);
  const double lean = (there.upper - (found.lower - way)) / way;  // 1 - cosine of the angle
  return lean <= leaning ? std::sqrt(2 * std::max(lean, 0.0)) : not_known;
}

/// Same with a long step first. A short step separates directions of nearly the same depth, but
/// takes longer.
double tilt_of_depth(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                     const Affine<double>& pose_b, const SignedDistance& found) {
  constexpr double rounded = 1.01;
  if (found.has_one_direction) [[likely]]
    return rounded * std::sqrt(2 * leaning);
  double tilt = tilt_of_depth(a, pose_a, b, pose_b, found, 1e-4, 1e-9);
  if (tilt == not_known) tilt = tilt_of_depth(a, pose_a, b, pose_b, found, 1e-7, 1e-14);
  return rounded * tilt;
}

/// Returns a smaller such angle, which bounds of the error need: the longer the step, the smaller.
double least_tilt_of_depth(const ContactShape& a, const Affine<double>& pose_a,
                           const ContactShape& b, const Affine<double>& pose_b,
                           const SignedDistance& found) {
  constexpr double rounded = 1.01;
  for (const double step : {1e-2, 1e-4}) {
    const double tilt = tilt_of_depth(a, pose_a, b, pose_b, found, step, 1e-12);
    if (tilt != not_known) return rounded * tilt;
  }
  return not_known;
}

/// True if the normal may be less accurate than derivatives require. This is so for shapes known
/// only by their support mapping, and for shapes that nearly touch and have no closed form.
bool may_be_rough(const ShapeCore& a, const ShapeCore& b, double interval, double between_cores) {
  if (a.kind == CoreKind::other || b.kind == CoreKind::other) return true;
  constexpr double precise = 1e-6;
  const auto is_searched = [](const ShapeCore& core) {
    return core.kind != CoreKind::point && core.kind != CoreKind::segment;
  };
  return between_cores > interval && is_searched(a) && is_searched(b) &&
         !(2 * interval <= precise * precise * between_cores);
}

/// Error bound of a half-space's normal, due to rounding.
constexpr double tilt_of_half_space = 64 * std::numeric_limits<double>::epsilon();

TwistDerivative of_point(const Vec3<double>& weight, const Vec3<double>& arm) {
  return {weight, arm.cross(weight)};
}

/// A body at the time of its first contact.
struct BodyAtContact {
  Vec3<double> arm;       ///< from its pivot to the contact point
  Vec3<double> velocity;  ///< of the contact point
  double angle = 0;       ///< by which it has turned
  Mat3<double> turn;      ///< not set if it has not turned
  Mat3<double> linear;

  BodyAtContact(const RigidMotion& motion, double time, const Vec3<double>& point)
      : arm(point - (motion.pose.translation + time * motion.velocity)),
        velocity(motion.velocity + motion.angular_velocity.cross(arm)),
        linear(motion.pose.linear) {
    const Vec3<double> rotation = time * motion.angular_velocity;
    angle = rotation.norm();
    if (!(angle > 0)) return;
    turn = Eigen::AngleAxis<double>(angle, rotation / angle).toRotationMatrix();
    linear = turn * motion.pose.linear;
  }

  /// Height of the contact point above the core's middle along the outward normal.
  double height(const ContactShape& shape, const Vec3<double>& normal) const {
    return normal.dot(arm - linear * shape.middle()) - shape.core().radius;
  }

  /// `weight` is the derivative with respect to the contact point. A turn of the body at time 0
  /// acts later about an axis that has turned with it.
  TwistDerivative derivative(const Vec3<double>& weight) const {
    TwistDerivative found = of_point(weight, arm);
    if (angle > 0) found.by_turn = turn.transpose() * found.by_turn;
    return found;
  }
};

/// Returns the contact of the cores, made more accurate if `is_rough`.
CoreContact contact_of(const CoresInWorld& cores, const Vec3<double>& middle,
                       const SignedDistance& found, bool is_rough) {
  const double radii = cores.a.radius + cores.b.radius;
  CoreContact contact{found.normal, found.point_a - middle - cores.a.radius * found.normal,
                      found.point_b - found.point_a + radii * found.normal};
  if (is_rough) sharpen(cores, contact);
  return contact;
}

/// The derivative of a distance that has both bounds.
PairDerivative of_distance(const ContactShape& a, const Affine<double>& pose_a,
                           const ContactShape& b, const Affine<double>& pose_b,
                           const SignedDistance& found, PairDerivativeError* error,
                           const Drift& drift) {
  const double interval = found.upper - found.lower;
  const double between_cores = found.value + a.core().radius + b.core().radius;
  PairDerivative derivative{of_point(-found.normal, found.point_a - pose_a.translation),
                            of_point(found.normal, found.point_b - pose_b.translation),
                            have_many_points(a, pose_a.linear, b, pose_b.linear, found.normal,
                                             interval, std::abs(between_cores))};
  double depth_tilt = not_known;
  if (!derivative.is_ridge && !(between_cores > interval)) {
    depth_tilt = tilt_of_depth(a, pose_a, b, pose_b, found);
    derivative.is_ridge = depth_tilt == not_known;
  }
  const bool is_rough = may_be_rough(a.core(), b.core(), interval, between_cores);
  if (!is_rough && !error) [[likely]]
    return derivative;
  const CoresInWorld cores(a, pose_a, b, pose_b);
  const Vec3<double> middle = middle_in_world(a, pose_a);
  const CoreContact contact = contact_of(cores, middle, found, is_rough);
  const Vec3<double> origin_a = pose_a.translation - middle, origin_b = pose_b.translation - middle;
  if (is_rough) {
    // Derivatives do not change if the points move along the normal, by the radii.
    derivative.a = of_point(-contact.normal, contact.a - origin_a);
    derivative.b = of_point(contact.normal, contact.a + contact.c - origin_b);
  }
  if (error && !derivative.is_ridge) {
    if (depth_tilt != not_known)
      depth_tilt = std::min(depth_tilt, least_tilt_of_depth(a, pose_a, b, pose_b, found));
    depth_tilt += (contact.normal - found.normal).norm();
    *error = error_of(cores, contact, found, depth_tilt, origin_a, origin_b, drift);
  }
  return derivative;
}

}  // namespace

PairDerivative derivative_of(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b,
                             const SignedDistance& found, PairDerivativeError* error,
                             const Drift& drift) {
  if (error) *error = {};
  if (found.is_unknown() || !std::isfinite(found.upper - found.lower)) return unknown(true);
  return of_distance(a, pose_a, b, pose_b, found, error, drift);
}

PairDerivative finest_derivative_of(const ContactShape& a, const Affine<double>& pose_a,
                                    const ContactShape& b, const Affine<double>& pose_b,
                                    PairDerivativeError* error) {
  return derivative_of(a, pose_a, b, pose_b,
                       signed_distance(a, pose_a, b, pose_b, for_derivatives()), error);
}

PairDerivative derivative_at_half_space(const Vec3<double>& origin, const ContactShape& b,
                                        const Affine<double>& pose_b, const SignedDistance& found,
                                        PairDerivativeError* error, const Drift& drift) {
  if (error) *error = {};
  if (found.is_unknown()) return unknown(true);
  PairDerivative derivative{of_point(-found.normal, found.point_a - origin),
                            of_point(found.normal, found.point_b - pose_b.translation)};
  derivative.is_ridge = region_at_half_space(b, pose_b, found).dimension > 0;
  if (error && !derivative.is_ridge)
    *error = error_at_half_space(b.core(), in_core(b, pose_b.linear, -found.normal),
                                 tilt_of_half_space, found, origin, pose_b.translation, drift);
  return derivative;
}

ContactRegion contact_region(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b,
                             const SignedDistance& found) {
  const double interval = found.upper - found.lower;
  if (found.is_unknown() || !std::isfinite(interval)) return {};
  const double between_cores = found.value + a.core().radius + b.core().radius;
  const ContactRegion region = touching_region(a, pose_a.linear, b, pose_b.linear, found.normal,
                                               interval, std::abs(between_cores));
  const bool has_one_normal =
      between_cores > interval || tilt_of_depth(a, pose_a, b, pose_b, found) != not_known;
  return has_one_normal ? region : ContactRegion();
}

ContactRegion region_at_half_space(const ContactShape& b, const Affine<double>& pose_b,
                                   const SignedDistance& found) {
  const FlatPart part =
      flat_part(b.core(), in_core(b, pose_b.linear, -found.normal), tilt_of_half_space);
  return {part.dimension, turn_in_world(b, pose_b) * part.along};
}

namespace {

PairDerivative of_hit(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                      const RigidMotion& motion_b, const Impact& found) {
  const BodyAtContact of_a(motion_a, found.t_lo, found.point_a),
      of_b(motion_b, found.t_lo, found.point_b);
  const double closing = found.normal.dot(of_a.velocity - of_b.velocity);
  constexpr double grazing = 1e-6;   // of the points' speeds: less is no approach to speak of
  constexpr double settled = 1e-12;  // error of a settled normal, in radians
  const double error =
      std::isfinite(found.normal_error) ? std::max(settled, found.normal_error) : settled;
  const double size = a.ball_radius() + b.ball_radius();
  const ContactHeights heights{of_a.height(a, found.normal), of_b.height(b, -found.normal)};
  return {of_a.derivative(-found.normal / closing), of_b.derivative(found.normal / closing),
          !(closing > grazing * (of_a.velocity.norm() + of_b.velocity.norm())) ||
              have_many_points(a, of_a.linear, b, of_b.linear, found.normal, error * error * size,
                               size, heights)};
}

}  // namespace

PairDerivative derivative_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found) {
  if (found.status == ImpactStatus::miss) return unknown(false);
  if (found.status == ImpactStatus::inside) return {};
  if (found.status == ImpactStatus::undecided || !std::isfinite(found.distance))
    return unknown(true);
  Impact settled = found;
  settle(a, motion_a, b, motion_b, settled);
  return of_hit(a, motion_a, b, motion_b, settled);
}

}  // namespace minkray
