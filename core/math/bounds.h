// SPDX-License-Identifier: MIT
// Axis-aligned bounding boxes, and bounding balls.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// An axis-aligned box; empty (lower > upper) by default.
template <class T>
struct Bounds {
  Vec3<T> lower = Vec3<T>::Constant(std::numeric_limits<T>::infinity());
  Vec3<T> upper = Vec3<T>::Constant(-std::numeric_limits<T>::infinity());

  bool empty() const { return !(lower.array() <= upper.array()).all(); }
  Vec3<T> centre() const { return lower * T(0.5) + upper * T(0.5); }
  Vec3<T> half_extents() const { return upper * T(0.5) - lower * T(0.5); }
  /// Returns half extents of a box around centre() that contains this box, although centre() is
  /// rounded.
  Vec3<T> reach_of_centre() const {
    const Vec3<T> middle = centre();
    return (upper - middle).cwiseMax(middle - lower);
  }

  void extend(const Vec3<T>& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void extend(const Bounds& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
};

/// The smallest box of floats that contains `bounds`, which must not be empty.
template <class T>
Bounds<float> rounded_outwards(const Bounds<T>& bounds) {
  Bounds<float> box;
  for (int axis = 0; axis < 3; ++axis) {
    float lower = static_cast<float>(bounds.lower[axis]);
    float upper = static_cast<float>(bounds.upper[axis]);
    if (T(lower) > bounds.lower[axis])
      lower = std::nextafter(lower, -std::numeric_limits<float>::infinity());
    if (T(upper) < bounds.upper[axis])
      upper = std::nextafter(upper, std::numeric_limits<float>::infinity());
    box.lower[axis] = lower;
    box.upper[axis] = upper;
  }
  return box;
}

/// A ball that contains a shape. Casts move the ray's origin near the ball's centre, and tolerances
/// are relative to the radius.
template <class T>
struct Ball {
  Vec3<T> centre = Vec3<T>::Zero();
  T radius = T(0);
};

}  // namespace minkray
