// SPDX-License-Identifier: MIT
// Ends of intervals that are sums of two numbers, as one number: rounded outwards, so that an
// interval of no width holds what it held.
#pragma once

#include <cmath>

#include "core/math/two_fold.h"

namespace minkray {

/// A number no larger than a + b, and equal if that is a number; less by two roundings at most.
template <class T>
T sum_or_less(T a, T b) {
  const TwoFold<T> sum = two_sum(a, b);
  const T lower = sum.high - std::abs(sum.high) * std::numeric_limits<T>::epsilon();
  return sum.low < T(0) ? lower : sum.high;
}

/// The other way.
template <class T>
T sum_or_more(T a, T b) {
  return -sum_or_less(T(-a), T(-b));
}

}  // namespace minkray
