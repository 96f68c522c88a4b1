// SPDX-License-Identifier: MIT
// Rays against the shapes that have short closed forms, in the ray's own precision: the limit that
// a general solver is measured against. Entry points only, for rays from outside.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/ray.h"

namespace minkray::bench {

/// What every closed form answers for a miss.
template <class T>
inline constexpr T no_hit = std::numeric_limits<T>::infinity();

/// The unit ball under a scaling, recentred at the ray's closest approach.
template <class T>
T ellipsoid_entry(const Vec3<T>& radii, const Ray<T>& ray) {
  const Vec3<T> o = ray.origin.cwiseQuotient(radii), d = ray.direction.cwiseQuotient(radii);
  const T dd = d.squaredNorm(), t = -o.dot(d) / dd;
  const T inside = T(1) - (o + t * d).squaredNorm();
  return inside < T(0) ? no_hit<T> : t - std::sqrt(inside / dd);
}

template <class T>
T box_entry(const Vec3<T>& half_extents, const Ray<T>& ray) {
  T enter = -no_hit<T>, leave = no_hit<T>;
  for (int axis = 0; axis < 3; ++axis) {
    const T inverse = T(1) / ray.direction[axis];
    const T a = (-half_extents[axis] - ray.origin[axis]) * inverse;
    const T b = (half_extents[axis] - ray.origin[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : no_hit<T>;
}

template <class T>
T cylinder_entry(T radius, T half_height, const Ray<T>& ray) {
  const auto& o = ray.origin;
  const auto& d = ray.direction;
  const T dd = d.x() * d.x() + d.y() * d.y();
  const T t = -(o.x() * d.x() + o.y() * d.y()) / dd;
  const T x = o.x() + t * d.x(), y = o.y() + t * d.y();
  const T inside = radius * radius - x * x - y * y;
  if (inside < T(0)) return no_hit<T>;
  const T half = std::sqrt(inside / dd);
  const T inverse = T(1) / d.z();
  const T a = (-half_height - o.z()) * inverse, b = (half_height - o.z()) * inverse;
  const T enter = std::max(t - half, std::min(a, b)), leave = std::min(t + half, std::max(a, b));
  return enter <= leave ? enter : no_hit<T>;
}

/// The side between the balls' centres, else the ball at the nearer end.
template <class T>
T capsule_entry(T radius, T half_height, const Ray<T>& ray) {
  const auto& o = ray.origin;
  const auto& d = ray.direction;
  const T dd = d.x() * d.x() + d.y() * d.y();
  const T t = -(o.x() * d.x() + o.y() * d.y()) / dd;
  const T x = o.x() + t * d.x(), y = o.y() + t * d.y();
  const T inside = radius * radius - x * x - y * y;
  if (inside < T(0)) return no_hit<T>;
  const T side = t - std::sqrt(inside / dd);
  const T z = o.z() + side * d.z();
  if (std::abs(z) <= half_height) return side;
  const Vec3<T> centre(T(0), T(0), std::copysign(half_height, z));
  return ellipsoid_entry<T>(Vec3<T>::Constant(radius), {o - centre, d});
}

}  // namespace minkray::bench
