// SPDX-License-Identifier: MIT
// Builds the result of a query on a pair of cores from a closed form. Its lower and upper bound are
// equal.
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

/// Builds the result whose nearest points are the point a of A and the point a + c of B. The axis
/// is the direction of c, or `otherwise` if c is 0.
inline CoreDistance closed_between(const Vec3<double>& a, const Vec3<double>& c,
                                   const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return closed_answer(length_of(c), direction.isZero(0) ? otherwise : direction, a, c);
}

}  // namespace minkray
