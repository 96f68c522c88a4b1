// SPDX-License-Identifier: MIT
// The plane that proves a miss, from two supporting planes that each separate one half of a ray.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// Let x be a point of the ray, which has the direction r. v is the normal of a supporting plane
/// that separates the shape from the part of the ray beyond x (v.r >= 0). `behind` is the normal of
/// a second supporting plane, which the ray crosses at x or before, and which separates the shape
/// from the part before x (behind.r < 0). Returns a weighted sum of the two normals that is
/// perpendicular to the ray: the normal of a plane between shape and ray. Proof: at x, the height
/// above the first plane is positive, and the height above the second is not negative. The weighted
/// sum of the heights is constant along the ray.
template <class T>
Vec3<T> joined_plane(const Vec3<T>& v, const Vec3<T>& behind, const Vec3<T>& r) {
  const T v_r = v.dot(r), behind_r = behind.dot(r);
  return behind_r < T(0) && v_r > T(0) ? Vec3<T>(v - behind * (v_r / behind_r)) : v;
}

}  // namespace minkray
