// SPDX-License-Identifier: MIT
// Bounding box and bounding ball of a shape, computed from two support points per axis.
#pragma once

#include "core/math/bounds.h"
#include "core/support/support_mapped.h"

namespace minkray {

/// The tightest axis-aligned box, exact up to the rounding of the support points.
template <class T = double, class S>
requires SupportMapped<S, T> Bounds<T> bounds_of(const S& shape) {
  Bounds<T> bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<T> direction = Vec3<T>::Unit(axis);
    bounds.upper[axis] = shape.support(direction)[axis];
    bounds.lower[axis] = shape.support(Vec3<T>(-direction))[axis];
  }
  return bounds;
}

/// The ball around the box that bounds_of() returns. Padded by a few ulps, so that the ball
/// contains the shape in spite of rounding.
template <class T>
Ball<T> ball_around(const Bounds<T>& bounds) {
  constexpr T padding = T(1) + T(8) * std::numeric_limits<T>::epsilon();
  return {bounds.centre(), bounds.reach_of_centre().stableNorm() * padding};
}

}  // namespace minkray
