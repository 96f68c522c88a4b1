// SPDX-License-Identifier: MIT
// Rays against the shapes that have short closed forms, in the ray's own precision: the limit that
// a general solver is measured against. Entry points only, for rays from outside.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/ray.h"

namespace minkray::bench {

/// Result of every closed form for a miss.
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

/// The cone below its apex, between two planes; the base is at z = -half_height.
template <class T>
T cone_entry(T radius, T half_height, const Ray<T>& ray) {
  const auto& o = ray.origin;
  const auto& d = ray.direction;
  const T slope = radius / (T(2) * half_height), square = slope * slope;
  const T z = o.z() - half_height;
  const T a = d.x() * d.x() + d.y() * d.y() - square * d.z() * d.z();
  const T b = o.x() * d.x() + o.y() * d.y() - square * z * d.z();
  const T c = o.x() * o.x() + o.y() * o.y() - square * z * z;
  const T discriminant = b * b - a * c;
  if (discriminant < T(0)) return no_hit<T>;
  const T q = -(b + std::copysign(std::sqrt(discriminant), b));
  const T one = q / a, other = c / q;
  // A steep line has an end in each nappe.
  const bool is_flat = a > T(0), down = d.z() < T(0);
  const T side_in = is_flat || !down ? std::min(one, other) : std::max(one, other);
  const T side_out = is_flat ? std::max(one, other) : side_in;
  const T inverse = T(1) / d.z();
  const T low = (-half_height - o.z()) * inverse, high = (half_height - o.z()) * inverse;
  const T enter = std::max(is_flat || down ? side_in : -no_hit<T>, std::min(low, high));
  const T leave = std::min(is_flat || !down ? side_out : no_hit<T>, std::max(low, high));
  return enter <= leave ? enter : no_hit<T>;
}

/// Walks past the slabs of the grown box, from one region around the box within to the next: in
/// each the distance to the box is that to a face, an edge or a corner.
template <class T>
T rounded_box_entry(const Vec3<T>& half_extents, T radius, const Ray<T>& ray) {
  Vec3<T> s, d, into, out;  // mirrored, so that the line runs towards positive coordinates
  T enter = -no_hit<T>, leave = no_hit<T>;
  for (int k = 0; k < 3; ++k) {
    const T sign = std::copysign(T(1), ray.direction[k]);
    s[k] = sign * ray.origin[k];
    d[k] = sign * ray.direction[k];
    const T inverse = T(1) / d[k];
    enter = std::max(enter, (-half_extents[k] - radius - s[k]) * inverse);
    leave = std::min(leave, (half_extents[k] + radius - s[k]) * inverse);
    into[k] = (-half_extents[k] - s[k]) * inverse;
    out[k] = (half_extents[k] - s[k]) * inverse;
  }
  if (enter > leave) return no_hit<T>;
  constexpr int most_regions = 7;
  T from = enter;
  for (int region = 0; region < most_regions; ++region) {
    T next = no_hit<T>, a = T(0), b = T(0), c = -radius * radius;
    for (int k = 0; k < 3; ++k) {
      const bool before = from < into[k];
      if (!before && from < out[k]) {
        next = std::min(next, out[k]);
        continue;
      }
      if (before) next = std::min(next, into[k]);
      const T p = s[k] + (before ? half_extents[k] : -half_extents[k]);
      a += d[k] * d[k];
      b += p * d[k];
      c += p * p;
    }
    const T discriminant = b * b - a * c;
    const T t = discriminant > T(0) ? (-b - std::sqrt(discriminant)) / a : -b / a;
    if (!(t > next)) return discriminant > T(0) ? t : no_hit<T>;
    from = next;
  }
  return no_hit<T>;
}

}  // namespace minkray::bench
