// SPDX-License-Identifier: MIT
// Motion of a body while time goes from 0 to 1: the body turns at a constant rate about a pivot
// that moves along a line. A ray with a time is moved back with the body to time 0, and cast at the
// body's pose at time 0. This is exact: the shape itself is not changed.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/math/ray.h"

namespace minkray {

template <class T>
struct Movement {
  Vec3<T> shift = Vec3<T>::Zero();  ///< displacement of the pivot from time 0 to time 1
  T angle = T(0);  ///< turn from time 0 to time 1 in radians, by the right-hand rule
  Vec3<T> axis = Vec3<T>::UnitZ();
  Vec3<T> pivot = Vec3<T>::Zero();  ///< position at time 0

  bool stands() const { return angle == T(0) && shift.isZero(T(0)); }

  /// Rotates a direction back to the body's orientation at time 0, and forward again.
  Vec3<T> unturned(const Vec3<T>& direction, T time) const {
    return angle == T(0) ? direction : by_angle(direction, -angle * time);
  }
  Vec3<T> turned(const Vec3<T>& direction, T time) const {
    return angle == T(0) ? direction : by_angle(direction, angle * time);
  }

  /// Moves a ray, or a point, back with the body to time 0.
  Ray<T> unmoved(const Ray<T>& ray, T time) const {
    return {unmoved(ray.origin, time), unturned(ray.direction, time), ray.t_max};
  }
  Vec3<T> unmoved(const Vec3<T>& point, T time) const {
    const Vec3<T> unshifted = point - time * shift;
    return angle == T(0) ? unshifted : Vec3<T>(pivot + unturned(unshifted - pivot, time));
  }

  /// Returns a bound of the rounding error of `unmoved` for a ray with this origin, at points near
  /// the pivot or the origin: a dozen roundings of the distance between these two.
  T rounding(const Vec3<T>& origin) const {
    constexpr T roundings = T(6) * std::numeric_limits<T>::epsilon();
    return roundings * (origin.norm() + pivot.norm() + shift.norm());
  }

  /// Returns the position at `time` of the body's point that is at `point` at time 0.
  Vec3<T> moved(const Vec3<T>& point, T time) const {
    return angle == T(0) ? Vec3<T>(point + time * shift)
                         : Vec3<T>(pivot + time * shift + turned(point - pivot, time));
  }

  /// Returns the pose at `time` of a body whose pose at time 0 is given.
  Affine<T> moved(const Affine<T>& pose, T time) const {
    Affine<T> now = pose;
    for (int column = 0; column < 3; ++column)
      now.linear.col(column) = turned(pose.linear.col(column), time);
    now.translation = moved(pose.translation, time);
    return now;
  }

  /// Returns a box that contains the body at all times, given its boxes at time 0 and 1. The path
  /// of a point at the distance rho from the axis has the second derivative rho angle^2. The path
  /// is therefore at most rho angle^2 / 8 from the line between its end points.
  Bounds<T> swept(const Bounds<T>& begin, const Bounds<T>& end) const {
    Bounds<T> all = begin;
    all.extend(end);
    if (angle == T(0)) return all;
    T rho_squared = T(0), reach_squared = T(0);
    for (int corner = 0; corner < 8; ++corner) {
      Vec3<T> arm;
      for (int i = 0; i < 3; ++i)
        arm[i] = (corner >> i & 1 ? begin.upper[i] : begin.lower[i]) - pivot[i];
      reach_squared = std::max(reach_squared, arm.squaredNorm());
      rho_squared = std::max(rho_squared, arm.cross(axis).squaredNorm());
    }
    const T beside = std::sqrt(rho_squared) * angle * angle / T(8);
    all.lower.array() -= beside;
    all.upper.array() += beside;
    // The body also stays in a ball around the moving pivot.
    const T reach = std::sqrt(reach_squared);
    Bounds<T> balls{pivot - Vec3<T>::Constant(reach), pivot + Vec3<T>::Constant(reach)};
    balls.extend(Bounds<T>{balls.lower + shift, balls.upper + shift});
    return {all.lower.cwiseMax(balls.lower), all.upper.cwiseMin(balls.upper)};
  }

 private:
  /// Rotates v about the axis by the angle phi (Rodrigues' formula).
  Vec3<T> by_angle(const Vec3<T>& v, T phi) const {
    const T cosine = std::cos(phi), sine = std::sin(phi);
    return cosine * v + sine * axis.cross(v) + (T(1) - cosine) * axis.dot(v) * axis;
  }
};

}  // namespace minkray
