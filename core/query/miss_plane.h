// SPDX-License-Identifier: MIT
// The plane that proves a miss, from two supporting planes that each keep off one half of a ray.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// v is the normal of a supporting plane that keeps the shape off the ray ahead of a point x of it
/// (v.r >= 0), `behind` that of one which touches x or lies before it and keeps it off what lies
/// behind x (behind.r < 0). Their sum along the ray separates shape and ray: at x the first is
/// positive, the second not negative, and along the ray the sum does not change.
template <class T>
Vec3<T> joined_plane(const Vec3<T>& v, const Vec3<T>& behind, const Vec3<T>& r) {
  const T v_r = v.dot(r), behind_r = behind.dot(r);
  return behind_r < T(0) && v_r > T(0) ? Vec3<T>(v - behind * (v_r / behind_r)) : v;
}

}  // namespace minkray
