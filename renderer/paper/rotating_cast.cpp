// SPDX-License-Identifier: MIT
#include "renderer/paper/rotating_cast.h"

#include <cmath>

#include "core/math/length.h"
#include "renderer/paper/distance.h"

namespace minkray {
namespace {

/// The body with the orientation of the middle of the step and the position of its beginning.
CentredShape frozen(const Shape& shape, const RigidMotion& motion, double begin, double middle) {
  Affine<double> pose = motion.at(middle);
  pose.translation = motion.pose.translation + begin * motion.velocity;
  return centred(shape, pose);
}

/// Upper bound of the distance from the pivot to the body's furthest point.
double radius_about_pivot(const Shape& shape, const RigidMotion& motion) {
  const CentredShape placed = centred(shape, motion.pose);
  return length_of<double>(placed.centre - motion.pose.translation) + placed.radius;
}

}  // namespace

RotatingCastResult cast_rotating(const Shape& a, const RigidMotion& motion_a, const Shape& b,
                                 const RigidMotion& motion_b, double duration, int steps,
                                 const CastOptions& options) {
  RotatingCastResult result;
  const double step = duration / double(steps);
  result.position_error =
      (radius_about_pivot(a, motion_a) * length_of<double>(motion_a.angular_velocity) +
       radius_about_pivot(b, motion_b) * length_of<double>(motion_b.angular_velocity)) *
      step / 2.0;
  const Vec3<double> relative = motion_b.velocity - motion_a.velocity;
  bool lower_found = false;

  for (int i = 0; i < steps; ++i) {
    ++result.steps;
    const double begin = double(i) * step;
    const CentredShape A = frozen(a, motion_a, begin, begin + step / 2.0);
    const CentredShape B = frozen(b, motion_b, begin, begin + step / 2.0);

    if (!lower_found) {
      CentredShape grown = A;
      grown.about_centre = Rounded{result.position_error, Nested(A.about_centre)};
      grown.radius += result.position_error;
      const ShapeCastResult early = cast_shape(PreparedPair(grown, B), relative, step, options);
      result.iterations += early.cast.iterations;
      result.supports += early.cast.supports;
      if (early.cast.status == Status::miss) continue;  // the shape that is not grown misses, too
      lower_found = true;
      result.t_lo = early.cast.found() ? begin + early.cast.t() : begin;
    }

    const ShapeCastResult now = cast_shape(PreparedPair(A, B), relative, step, options);
    result.iterations += now.cast.iterations;
    result.supports += now.cast.supports;
    if (now.cast.status == Status::miss) continue;
    result.status = now.cast.status == Status::inside && i > 0 ? Status::hit : now.cast.status;
    result.t = begin + now.cast.t();
    result.point_a = now.point_a + now.cast.t() * motion_a.velocity;
    result.point_b = now.point_b + now.cast.t() * motion_a.velocity;
    result.normal = now.cast.normal;
    // If a change of orientation makes the bodies overlap at once, the normal is that of a plane
    // between them just before.
    if (result.status == Status::hit && result.normal.isZero(0)) {
      const double before = begin - step / 2.0;
      const CentredShape A_before = frozen(a, motion_a, begin, before),
                         B_before = frozen(b, motion_b, begin, before);
      const DistanceResult<double, 3> distance = distance_between(A_before, B_before);
      result.iterations += distance.iterations;
      result.supports += distance.supports;
      result.normal =
          distance.axis.isZero(0) ? unit<double>(B_before.centre - A_before.centre) : distance.axis;
    }
    return result;
  }
  result.status = Status::miss;
  result.t = duration;
  result.proven = !lower_found;
  if (!lower_found) result.t_lo = duration;
  return result;
}

}  // namespace minkray
