// SPDX-License-Identifier: MIT
// Common part of the closed forms of pairs of cores: a result whose bounds are equal.
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

/// Result for the vector c from a to B's point. Its axis is c's direction; `otherwise` if c is 0.
inline CoreDistance closed_between(const Vec3<double>& a, const Vec3<double>& c,
                                   const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return closed_answer(length_of(c), direction.isZero(0) ? otherwise : direction, a, c);
}

}  // namespace minkray
