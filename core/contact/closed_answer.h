// SPDX-License-Identifier: MIT
// What closed forms of pairs of cores have in common: the answer whose bounds are one number, and
// lengths.
#pragma once

#include "core/contact/core_pair.h"

namespace minkray {

inline CoreDistance closed_answer(double distance, const Vec3<double>& axis, const Vec3<double>& a,
                                  const Vec3<double>& c) {
  CoreDistance result;
  result.status = distance > 0 ? CoreStatus::separated : CoreStatus::overlapping;
  result.lower = result.upper = distance;
  result.axis = axis;
  result.a = a;
  result.c = c;
  return result;
}

/// It is stableNorm(), which scales, without that where squares are ordinary numbers.
inline double length_of(const Vec3<double>& c) {
  constexpr double smallest = 1e-280, largest = 1e280;
  const double squared = c.squaredNorm();
  return squared > smallest && squared < largest ? std::sqrt(squared) : c.stableNorm();
}

/// c's direction; where there is none, `otherwise`.
inline CoreDistance closed_between(const Vec3<double>& a, const Vec3<double>& c,
                                   const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return closed_answer(length_of(c), direction.isZero(0) ? otherwise : direction, a, c);
}

/// std::hypot, where squares are ordinary numbers.
inline double length_of(double x, double y) {
  constexpr double smallest = 1e-280, largest = 1e280;
  const double squared = x * x + y * y;
  return squared > smallest && squared < largest ? std::sqrt(squared) : std::hypot(x, y);
}

}  // namespace minkray
