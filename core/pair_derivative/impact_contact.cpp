// SPDX-License-Identifier: MIT
#include "core/pair_derivative/impact_contact.h"

#include "core/pair_derivative/pair_derivative.h"

namespace minkray {
namespace {

bool is_curved(const ShapeCore& core) {
  return core.kind == CoreKind::other || slides(core.kind);
}

/// Sets normal and points to those of a contact of the cores.
void take(const CoresInWorld& cores, const Vec3<double>& middle, const CoreContact& contact,
          const Vec3<double>& shift, Impact& found) {
  found.normal = contact.normal;
  found.point_a = middle + contact.a + cores.a.radius * contact.normal;
  found.point_b = middle + contact.a + contact.c - cores.b.radius * contact.normal - shift;
}

/// Moves B away along the normal by a small part of the sizes, where the distance determines the
/// normal. This normal has a smaller error than the given one, by the ratio of that distance to the
/// surfaces' radii of curvature.
bool settle_apart(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                  const Affine<double>& pose_b, const Vec3<double>& middle, Impact& found) {
  constexpr double part = 1e-3;
  const double way = part * (a.ball_radius() + b.ball_radius());
  const Vec3<double> shift = way * found.normal;
  Affine<double> apart = pose_b;
  apart.translation += shift;
  const SignedDistance there = signed_distance(a, pose_a, b, apart, for_derivatives());
  if (there.status != SignedStatus::separated || !std::isfinite(there.upper)) return false;
  const CoresInWorld cores(a, pose_a, b, apart);
  const double radii = cores.a.radius + cores.b.radius;
  CoreContact contact{there.normal, there.point_a - middle - cores.a.radius * there.normal,
                      there.point_b - there.point_a + radii * there.normal};
  sharpen(cores, contact);
  take(cores, middle, contact, shift, found);
  return true;
}

/// True if the search estimated the normal's error, and the contact is not so oblique that the
/// error matters.
bool has_small_error(const RigidMotion& motion_a, const RigidMotion& motion_b,
                     const Impact& found) {
  constexpr double small = 1e-7;
  const Vec3<double> velocity = motion_b.velocity - motion_a.velocity;
  return found.normal_error * velocity.norm() <= small * std::abs(found.normal.dot(velocity));
}

/// True for bodies of known kinds that do not turn, if both are polytopes or the times' bounds are
/// close: the error of the normal is the square root of their gap.
bool is_accurate(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                 const RigidMotion& motion_b, const Impact& found) {
  constexpr double close = 1e-13;  // of the sizes
  if (a.core().kind == CoreKind::other || b.core().kind == CoreKind::other) return false;
  if (motion_a.angular_velocity != Vec3<double>::Zero() ||
      motion_b.angular_velocity != Vec3<double>::Zero())
    return false;
  if (!is_curved(a.core()) && !is_curved(b.core())) return true;
  const double speed = (motion_b.velocity - motion_a.velocity).norm();
  return (found.t_hi - found.t_lo) * speed <= close * (a.ball_radius() + b.ball_radius());
}

}  // namespace

void settle(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
            const RigidMotion& motion_b, Impact& found) {
  if (has_small_error(motion_a, motion_b, found)) return;
  found.normal_error = std::numeric_limits<double>::infinity();
  if (is_accurate(a, motion_a, b, motion_b, found)) return;
  const Affine<double> pose_a = motion_a.at(found.t_lo), pose_b = motion_b.at(found.t_lo);
  const Vec3<double> middle = middle_in_world(a, pose_a);
  if (is_curved(a.core()) || is_curved(b.core())) {
    const CoresInWorld cores(a, pose_a, b, pose_b);
    CoreContact contact{found.normal, Vec3<double>::Zero(), Vec3<double>::Zero()};
    if (sharpen_curved(cores, contact))
      return take(cores, middle, contact, Vec3<double>::Zero(), found);
  }
  constexpr double same = 1e-7;
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3<double> before = found.normal;
    if (!settle_apart(a, pose_a, b, pose_b, middle, found)) return;
    if ((found.normal - before).norm() <= same) return;
  }
}

}  // namespace minkray
