// SPDX-License-Identifier: MIT
// Lengths of vectors, including vectors whose squared length underflows or overflows. For all other
// vectors, these functions are as fast as norm().
#pragma once

#include <cmath>
#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// True if, in a vector with this squared length, the squares of all components that affect the
/// length are normal numbers. unit() (core/math/vec.h) uses the same limits.
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

/// Same; also accepts Eigen expressions, which are evaluated first.
inline double length_of(const Vec3<double>& v) {
  return length_of<double>(v);
}

inline double length_of(double x, double y) {
  const double squared = x * x + y * y;
  return is_ordinary_square(squared) ? std::sqrt(squared) : std::hypot(x, y);
}

}  // namespace minkray
