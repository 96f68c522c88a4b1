// SPDX-License-Identifier: MIT
// A ray seen from the shape's neighbourhood: precision must not depend on how far away its origin
// is, so its parameter is split into a part that leads to the shape's centre and a part that is
// counted from there.
#pragma once

#include "core/math/bounds.h"
#include "core/math/ray.h"

namespace minkray {

/// The points centre + s + lambda * r, lambda_min <= lambda <= lambda_max: lambda is a length, r
/// of unit length (or zero, for a ray without direction), s the ray's closest approach to centre.
template <class T>
struct RayNearBall {
  Vec3<T> s;
  Vec3<T> r;
  T lambda_min;  ///< where the ray's origin is
  T lambda_max;  ///< where the ray ends
  T t_base;      ///< the ray's own parameter at s is t_base + t_shift
  T t_shift;
  T t_per_length;

  T t_offset(T lambda) const { return t_shift + lambda * t_per_length; }

  /// The same points, walked the other way.
  RayNearBall reversed() const {
    return {s, -r, -lambda_max, -lambda_min, t_base, t_shift, -t_per_length};
  }

  /// The ray's image under a linear map that takes the old centre to the new one; parameters stay.
  RayNearBall mapped(const Mat3<T>& linear) const {
    RayNearBall image = *this;
    image.s = linear * s;
    const Vec3<T> direction = linear * r;
    image.r = unit(direction);
    const T length = image.r.dot(direction);
    if (!(length > T(0))) return image;
    const T correction = -image.s.dot(image.r);
    image.s += correction * image.r;
    image.t_per_length = t_per_length / length;
    image.t_shift = t_shift + correction * image.t_per_length;
    image.lambda_min = lambda_min * length - correction;
    image.lambda_max = lambda_max * length - correction;
    return image;
  }
};

/// The ray moved to its closest approach to `centre`. Two steps, since the rounding of the first
/// one's parameter is as coarse as the origin is far; s itself is rounded only as coarsely as
/// centre and shape are large, because fma rounds once and walks along the direction as given, not
/// along a rounded unit vector.
template <class T>
RayNearBall<T> ray_near(const Vec3<T>& centre, const Ray<T>& ray) {
  RayNearBall<T> near;
  const T longest = ray.direction.cwiseAbs().maxCoeff();
  if (!(longest > T(0))) {
    near.s = ray.origin - centre;
    near.r = Vec3<T>::Zero();
    near.lambda_min = near.lambda_max = near.t_base = near.t_shift = near.t_per_length = T(0);
    return near;
  }
  // A power of two keeps the scaled direction exact, and its square in range.
  int exponent = 0;
  std::frexp(longest, &exponent);
  const Vec3<T> direction(std::ldexp(ray.direction.x(), -exponent),
                          std::ldexp(ray.direction.y(), -exponent),
                          std::ldexp(ray.direction.z(), -exponent));
  const T squared = direction.squaredNorm();
  const T length = std::sqrt(squared);
  const auto along = [&](const Vec3<T>& from, T steps) -> Vec3<T> {
    return {std::fma(steps, direction.x(), from.x()), std::fma(steps, direction.y(), from.y()),
            std::fma(steps, direction.z(), from.z())};
  };
  const T steps = -(ray.origin - centre).dot(direction) / squared;
  const Vec3<T> close = along(ray.origin, steps) - centre;
  const T more_steps = -close.dot(direction) / squared;
  near.s = along(close, more_steps);
  near.r = direction / length;
  near.t_base = std::ldexp(steps, -exponent);
  near.t_shift = std::ldexp(more_steps, -exponent);
  near.t_per_length = std::ldexp(T(1) / length, -exponent);
  near.lambda_min = -steps * length - more_steps * length;
  near.lambda_max = std::ldexp(ray.t_max, exponent) * length + near.lambda_min;
  return near;
}

}  // namespace minkray
