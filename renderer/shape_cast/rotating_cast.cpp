// SPDX-License-Identifier: MIT
#include "renderer/shape_cast/rotating_cast.h"

#include <cmath>

#include "core/math/length.h"
#include "core/pair_motion/impact.h"
#include "renderer/shape_cast/distance.h"

namespace minkray {
namespace {

/// The body with the orientation of the middle of the step and the position of its beginning.
CentredShape frozen(const MovingBody& body, double begin, double middle) {
  Affine<double> pose = pose_at(body, middle);
  pose.translation = body.pose.translation + begin * body.velocity;
  return centred(body.shape, pose);
}

/// Upper bound of the distance from the pivot to the body's furthest point.
double radius_about_pivot(const MovingBody& body) {
  const CentredShape placed = centred(body.shape, body.pose);
  return length_of<double>(placed.centre - body.pose.translation) + placed.radius;
}

}  // namespace

Affine<double> pose_at(const MovingBody& body, double time) {
  return RigidMotion{body.pose, body.velocity, body.angular_velocity}.at(time);
}

RotatingCastResult cast_rotating(const MovingBody& a, const MovingBody& b, double duration,
                                 int steps, const CastOptions& options) {
  RotatingCastResult result;
  const double step = duration / double(steps);
  result.position_error = (radius_about_pivot(a) * length_of<double>(a.angular_velocity) +
                           radius_about_pivot(b) * length_of<double>(b.angular_velocity)) *
                          step / 2.0;
  const Vec3<double> relative = b.velocity - a.velocity;
  bool lower_found = false;

  for (int i = 0; i < steps; ++i) {
    ++result.steps;
    const double begin = double(i) * step;
    const CentredShape A = frozen(a, begin, begin + step / 2.0);
    const CentredShape B = frozen(b, begin, begin + step / 2.0);

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
    result.point_a = now.point_a + now.cast.t() * a.velocity;
    result.point_b = now.point_b + now.cast.t() * a.velocity;
    result.normal = now.cast.normal;
    // If a change of orientation makes the bodies overlap at once, the normal is that of a plane
    // between them just before.
    if (result.status == Status::hit && result.normal.isZero(0)) {
      const double before = begin - step / 2.0;
      const CentredShape A_before = frozen(a, begin, before), B_before = frozen(b, begin, before);
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
