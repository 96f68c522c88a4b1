// SPDX-License-Identifier: MIT
// Lengths of vectors whose squares may under- or overflow, as fast as others where they do not.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// True if squares of the components that count are normal numbers, as for unit()
/// (core/math/vec.h).
template <class T>
bool is_ordinary_square(T squared) {
  constexpr T smallest = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon() * T(16);
  constexpr T largest = T(1) / smallest;
  return squared > smallest && squared < largest;
}

template <class T>
T length_of(const Vec3<T>& v) {
  const T squared = v.squaredNorm();
  return is_ordinary_square(squared) ? std::sqrt(squared) : v.stableNorm();
}

/// This one takes expressions, which are worked out first.
inline double length_of(const Vec3<double>& v) {
  return length_of<double>(v);
}

inline double length_of(double x, double y) {
  const double squared = x * x + y * y;
  return is_ordinary_square(squared) ? std::sqrt(squared) : std::hypot(x, y);
}

}  // namespace minkray
