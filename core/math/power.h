// SPDX-License-Identifier: MIT
// Powers of nonnegative numbers. Results for single numbers and for packets are bit-identical,
// which the C library's pow does not guarantee: its long double logarithm differs between
// processors. The relative error is a few epsilon. For small powers the relative error may be
// larger, but the absolute error is at most a few epsilon.
#pragma once

#include "core/math/vec.h"

namespace minkray {

namespace detail {

/// Numbers of terms of the two series, enough for the digits of T.
template <class T>
struct SeriesTerms {
  static_assert(std::numeric_limits<T>::digits <= 64, "more digits need more terms");
  static constexpr int log2 = std::is_same_v<T, float> ? 5 : std::is_same_v<T, double> ? 11 : 13;
  static constexpr int exp2 = std::is_same_v<T, float> ? 7 : std::is_same_v<T, double> ? 13 : 16;
};

}  // namespace detail

/// log2(x) for positive normal numbers x; undefined for others.
template <class W>
W log2_of(const W& x) {
  using T = Lane<W>;
  constexpr T sqrt2 = T(1.41421356237309504880L), log2_e = T(1.44269504088896340736L);
  // x = 2^k m with m from 1/sqrt(2) to sqrt(2), and log m = 2 artanh((m - 1)/(m + 1)).
  const W power = leading_power_of_two(x);
  const W from_1 = x / power;
  const Mask<W> above = from_1 > W(sqrt2);
  const W m = from_1 * select(above, W(T(0.5)), W(1));
  const W k = exponent_of(power) + select(above, W(1), W(0));
  const W t = (m - W(1)) / (m + W(1)), t2 = t * t;
  constexpr int terms = detail::SeriesTerms<T>::log2;  // t^2 < 0.03
  W series = W(T(1) / T(2 * terms - 1));
  for (int i = terms - 1; i > 0; --i) series = series * t2 + W(T(1) / T(2 * i - 1));
  return k + t * series * W(T(2) * log2_e);
}

/// 2^x; 0 if the result would be subnormal, and the largest power of two if it would overflow.
template <class W>
W exp2_of(const W& x) {
  using std::max;
  using std::min;
  using T = Lane<W>;
  constexpr T ln2 = T(0.69314718055994530942L);
  constexpr T least = T(std::numeric_limits<T>::min_exponent - 1);
  constexpr T most = T(std::numeric_limits<T>::max_exponent - 1);
  const W bounded = min(max(x, W(least)), W(most));
  // Rounds to the nearest integer: adds and subtracts a number so large that sums have no fraction.
  constexpr T no_fraction = T(1.5) / std::numeric_limits<T>::epsilon();
  const W k = (bounded + W(no_fraction)) - W(no_fraction);
  const W y = (bounded - k) * W(ln2);
  constexpr int terms = detail::SeriesTerms<T>::exp2;  // |y| < 0.35
  W series(1);
  for (int i = terms; i > 0; --i) series = series * y * W(T(1) / T(i)) + W(1);
  return select(x < W(least), W(0), W(series * two_to(k)));
}

/// base^exponent for base >= 0; 0^exponent is 0 unless the exponent is 0. The exponent may be
/// infinite.
template <class W>
W power(const W& base, Lane<W> exponent) {
  using T = Lane<W>;
  if (exponent == T(0)) return W(1);
  // Small integer exponents need only products, some fractions only square roots. Both are common.
  constexpr T most_by_hand = T(16);
  if (exponent > T(0) && exponent <= most_by_hand && exponent == std::floor(exponent)) {
    int left = static_cast<int>(exponent);
    W square = base;
    for (; left % 2 == 0; left /= 2) square *= square;
    W product = square;
    while ((left /= 2) > 0) {
      square *= square;
      if (left % 2 != 0) product *= square;
    }
    return product;
  }
  if (!(exponent <= std::numeric_limits<T>::max()))
    return select(base < W(1), W(0), select(base > W(1), exp2_of<W>(W(exponent)), W(1)));
  using std::sqrt;
  if (exponent == T(0.5)) return sqrt(base);
  if (exponent == T(0.25)) return sqrt(sqrt(base));
  // Subnormal numbers have no leading power of two, and are scaled up first.
  constexpr T smallest = std::numeric_limits<T>::min();
  constexpr T digits = T(std::numeric_limits<T>::digits);
  const Mask<W> some = base > W(0), small = base < W(smallest);
  W normal = select(some, base, W(1)), brought_up(0);
  if (any(small)) {
    normal = select(small & some, W(normal * W(T(1) / std::numeric_limits<T>::epsilon())), normal);
    brought_up = select(small & some, W(digits - T(1)), W(0));
  }
  const W result = exp2_of<W>((log2_of<W>(normal) - brought_up) * W(exponent));
  return select(some, result, W(0));
}

}  // namespace minkray
