// SPDX-License-Identifier: MIT
// Rounds the ends of an interval outwards, from sums of two numbers to single numbers, so that the
// new interval contains the old one.
#pragma once

#include <cmath>

#include "core/math/two_fold.h"

namespace minkray {

/// Returns a number that is at most a + b: equal if a + b is a number of T, otherwise less by at
/// most two roundings.
template <class T>
T sum_or_less(T a, T b) {
  const TwoFold<T> sum = two_sum(a, b);
  const T lower = sum.high - std::abs(sum.high) * std::numeric_limits<T>::epsilon();
  return sum.low < T(0) ? lower : sum.high;
}

/// Returns a number that is at least a + b: equal if a + b is a number of T, otherwise greater by
/// at most two roundings.
template <class T>
T sum_or_more(T a, T b) {
  return -sum_or_less(T(-a), T(-b));
}

}  // namespace minkray
