// SPDX-License-Identifier: MIT
#include "core/shape_cast/rotating_cast.h"

#include <cmath>

#include "core/math/length.h"
#include "core/shape_cast/distance.h"

namespace minkray {
namespace {

/// The orientation in the middle of the step, the position at its beginning.
template <class T>
CentredShape<T> frozen(const MovingBody<T>& body, T begin, T middle) {
  Affine<T> pose = pose_at(body, middle);
  pose.translation = body.pose.translation + begin * body.velocity;
  return centred(body.shape, pose);
}

/// The distance from the pivot to the body's furthest point, or a little more.
template <class T>
T radius_about_pivot(const MovingBody<T>& body) {
  const CentredShape<T> placed = centred(body.shape, body.pose);
  return length_of<T>(placed.centre - body.pose.translation) + placed.radius;
}

}  // namespace

template <class T>
Affine<T> pose_at(const MovingBody<T>& body, T time) {
  Affine<T> pose = body.pose;
  pose.translation += time * body.velocity;
  const T speed = length_of<T>(body.angular_velocity), angle = time * speed;
  if (angle > T(0))
    pose.linear = Eigen::AngleAxis<T>(angle, body.angular_velocity / speed).toRotationMatrix() *
                  body.pose.linear;
  return pose;
}

template <class T>
RotatingCastResult<T> cast_rotating(const MovingBody<T>& a, const MovingBody<T>& b, T duration,
                                    int steps, const CastOptions<T>& options) {
  RotatingCastResult<T> result;
  const T step = duration / T(steps);
  result.position_error = (radius_about_pivot(a) * length_of<T>(a.angular_velocity) +
                           radius_about_pivot(b) * length_of<T>(b.angular_velocity)) *
                          step / T(2);
  const Vec3<T> relative = b.velocity - a.velocity;
  bool lower_found = false;

  for (int i = 0; i < steps; ++i) {
    ++result.steps;
    const T begin = T(i) * step;
    const CentredShape<T> A = frozen(a, begin, begin + step / T(2));
    const CentredShape<T> B = frozen(b, begin, begin + step / T(2));

    if (!lower_found) {
      CentredShape<T> grown = A;
      grown.about_centre = Rounded<T>{result.position_error, Nested<T>(A.about_centre)};
      grown.radius += result.position_error;
      const ShapeCastResult<T> early =
          cast_shape(PreparedPair<T>(grown, B), relative, step, options);
      result.iterations += early.cast.iterations;
      result.supports += early.cast.supports;
      if (early.cast.status == Status::miss) continue;  // and then the smaller one misses too
      lower_found = true;
      result.t_lo = early.cast.found() ? begin + early.cast.t() : begin;
    }

    const ShapeCastResult<T> now = cast_shape(PreparedPair<T>(A, B), relative, step, options);
    result.iterations += now.cast.iterations;
    result.supports += now.cast.supports;
    if (now.cast.status == Status::miss) continue;
    result.status = now.cast.status == Status::inside && i > 0 ? Status::hit : now.cast.status;
    result.t = begin + now.cast.t();
    result.point_a = now.point_a + now.cast.t() * a.velocity;
    result.point_b = now.point_b + now.cast.t() * a.velocity;
    result.normal = now.cast.normal;
    // The orientation changed at once, and the bodies were in each other: the plane was between
    // them before that.
    if (result.status == Status::hit && result.normal.isZero(T(0))) {
      const T before = begin - step / T(2);
      const CentredShape<T> A_before = frozen(a, begin, before),
                            B_before = frozen(b, begin, before);
      const DistanceResult<T, 3> distance = distance_between(A_before, B_before);
      result.iterations += distance.iterations;
      result.supports += distance.supports;
      result.normal =
          distance.axis.isZero(T(0)) ? unit<T>(B_before.centre - A_before.centre) : distance.axis;
    }
    return result;
  }
  result.status = Status::miss;
  result.t = duration;
  result.proven = !lower_found;
  if (!lower_found) result.t_lo = duration;
  return result;
}

#define MINKRAY_INSTANTIATE(T)                                                                     \
  template Affine<T> pose_at(const MovingBody<T>&, T);                                             \
  template RotatingCastResult<T> cast_rotating(const MovingBody<T>&, const MovingBody<T>&, T, int, \
                                               const CastOptions<T>&);
MINKRAY_INSTANTIATE(float)
MINKRAY_INSTANTIATE(double)
#undef MINKRAY_INSTANTIATE

}  // namespace minkray
