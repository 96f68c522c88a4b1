// SPDX-License-Identifier: MIT
// Half-space: all points on one side of a plane. Half-spaces are unbounded, so they have no support
// mapping, box or solver; rays are cast in closed form.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/affine.h"
#include "core/math/ray.h"
#include "core/math/two_fold.h"
#include "core/query/result.h"

namespace minkray {

/// The half-space of all points x with normal . x <= offset.
template <class T>
struct HalfSpaceBody {
  Vec3<T> normal = {T(0), T(0), T(1)};  ///< outward, of unit length
  T offset = T(0);
  /// Error bounds of each component of the normal, and of the offset, due to rounding in posed().
  T normal_error = T(0), offset_error = T(0);

  /// Maps the half-space by an invertible map.
  HalfSpaceBody posed(const Affine<T>& pose) const {
    constexpr T rounding = T(4) * std::numeric_limits<T>::epsilon();
    const Vec3<T> turned = unit<T>(accurate_inverse<T>(pose.linear).transpose() * normal);
    const Vec3<T> point = pose(offset * normal);
    const bool is_turned = pose.linear != Mat3<T>::Identity();
    const T size = Vec3<T>(pose.linear * (offset * normal)).stableNorm();
    return {turned, turned.dot(point), is_turned ? rounding : T(0),
            rounding * (is_turned ? T(point.template lpNorm<1>() + size)
                                  : T(turned.cwiseAbs().dot(point.cwiseAbs())))};
  }

  template <class U>
  HalfSpaceBody<U> cast() const {
    return {normal.template cast<U>(), static_cast<U>(offset), static_cast<U>(normal_error),
            static_cast<U>(offset_error)};
  }
};

/// Finds where the ray enters the half-space. The status is `inside` if the ray starts below the
/// plane; a ray parallel to the plane misses or starts inside. The bounds of t include rounding.
/// `exhausted` if the origin's height above the plane, the slope or t overflows.
template <class T>
CastResult<T> cast_ray(const HalfSpaceBody<T>& half_space, const Ray<T>& ray) {
  using std::abs, std::isfinite;
  // Bounds the rounding of three products and their sum, relative to the sum of their magnitudes.
  constexpr T rounding = T(4) * std::numeric_limits<T>::epsilon();
  const Vec3<T>& n = half_space.normal;
  const T height = n.dot(ray.origin) - half_space.offset;
  const T fall = -n.dot(ray.direction);
  CastResult<T> result;
  if (!isfinite(height) || !isfinite(fall)) return result;  // exhausted
  result.offset_lo = T(0);
  if (height <= T(0)) {
    result.status = Status::inside;
    result.offset_hi = T(0);
    return result;
  }
  const T t = height / fall;
  if (fall > T(0) && !isfinite(t) && !isfinite(ray.t_max)) return CastResult<T>();  // exhausted
  if (!(fall > T(0)) || !(t <= ray.t_max)) {
    result.status = Status::miss;
    result.normal = n;
    result.offset_hi = std::numeric_limits<T>::infinity();
    return result;
  }
  const T height_error =
      rounding * (n.cwiseAbs().dot(ray.origin.cwiseAbs()) + abs(half_space.offset)) +
      half_space.normal_error * ray.origin.template lpNorm<1>() + half_space.offset_error;
  const T fall_error = rounding * n.cwiseAbs().dot(ray.direction.cwiseAbs()) +
                       half_space.normal_error * ray.direction.template lpNorm<1>();
  result.status = Status::hit;
  result.t_offset = t;
  result.normal = n;
  result.offset_lo = (height - height_error) / (fall + fall_error) * (T(1) - rounding);
  result.offset_lo = result.offset_lo > T(0) ? result.offset_lo : T(0);
  result.offset_hi = fall > fall_error
                         ? (height + height_error) / (fall - fall_error) * (T(1) + rounding)
                         : std::numeric_limits<T>::infinity();
  return result;
}

}  // namespace minkray
