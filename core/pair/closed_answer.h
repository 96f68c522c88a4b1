// SPDX-License-Identifier: MIT
// Common part of the closed forms of pairs of cores: the result whose bounds are one number.
#pragma once

#include "core/math/length.h"
#include "core/pair/core_pair.h"

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

/// c's direction; where there is none, `otherwise`.
inline CoreDistance closed_between(const Vec3<double>& a, const Vec3<double>& c,
                                   const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return closed_answer(length_of(c), direction.isZero(0) ? otherwise : direction, a, c);
}

}  // namespace minkray
