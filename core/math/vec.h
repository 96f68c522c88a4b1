// SPDX-License-Identifier: MIT
// Vector and matrix types: Eigen's fixed-size columns and matrices over a scalar W, which is float,
// double or (for packets of rays) a vector of lanes. Code that also runs on packets uses the free
// functions of this file instead of `if`.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace minkray {

template <class W>
using Vec3 = Eigen::Matrix<W, 3, 1>;

/// Columns of another dimension, for algorithms that exist in 2D and 3D.
template <class W, int Dim>
using Vec = Eigen::Matrix<W, Dim, 1>;

template <class W>
using Mat3 = Eigen::Matrix<W, 3, 3>;

/// Gives the type of one lane of W (W itself unless W is a packet, core/math/wide.h), the type of
/// comparison results, and the number of lanes.
template <class W>
struct LaneOf {
  using type = W;
  using Mask = bool;
  static constexpr int count = 1;
};
template <class W>
using Lane = typename LaneOf<W>::type;
template <class W>
using Mask = typename LaneOf<W>::Mask;

/// `condition ? a : b`, lane by lane for packets.
template <std::floating_point W>
W select(bool condition, W a, W b) {
  return condition ? a : b;
}

/// True if the condition holds in any lane.
inline bool any(bool condition) {
  return condition;
}

/// True if the condition holds in all lanes.
inline bool all(bool condition) {
  return condition;
}

/// The largest power of two that is at most x; 0 if x is below the least normal number.
template <std::floating_point W>
W leading_power_of_two(W x) {
  if constexpr (sizeof(W) > sizeof(double)) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return x < std::numeric_limits<W>::min() ? W(0) : std::ldexp(W(0.5), exponent);
  } else {
    using Bits = std::conditional_t<sizeof(W) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<W>(std::bit_cast<Bits>(x) &
                            std::bit_cast<Bits>(std::numeric_limits<W>::infinity()));
  }
}

/// Returns k for the argument 2^k, which must be a normal number.
template <std::floating_point W>
W exponent_of(W power_of_two) {
  if constexpr (sizeof(W) > sizeof(double)) {
    int exponent = 0;
    std::frexp(power_of_two, &exponent);
    return W(exponent - 1);
  } else {
    // Makes the exponent's bits the last digits of a number whose last digit is worth 1.
    using Bits = std::conditional_t<sizeof(W) == 4, std::uint32_t, std::uint64_t>;
    constexpr int digits = std::numeric_limits<W>::digits - 1;
    constexpr W ones = W(1) / std::numeric_limits<W>::epsilon();
    constexpr W bias = W(std::numeric_limits<W>::max_exponent - 1);
    const Bits biased = std::bit_cast<Bits>(power_of_two) >> digits;
    return std::bit_cast<W>(biased | std::bit_cast<Bits>(ones)) - (ones + bias);
  }
}

/// 2^k for an integer k; the result must be a normal number.
template <std::floating_point W>
W two_to(W k) {
  if constexpr (sizeof(W) > sizeof(double)) {
    return std::ldexp(W(1), static_cast<int>(k));
  } else {
    using Bits = std::conditional_t<sizeof(W) == 4, std::uint32_t, std::uint64_t>;
    constexpr int digits = std::numeric_limits<W>::digits - 1;
    constexpr W ones = W(1) / std::numeric_limits<W>::epsilon();
    constexpr W bias = W(std::numeric_limits<W>::max_exponent - 1);
    return std::bit_cast<W>(std::bit_cast<Bits>(k + (ones + bias)) << digits);
  }
}

/// Selects a where the condition holds, else b, lane by lane.
template <class W, class Mask>
Vec3<W> select(const Mask& condition, const Vec3<W>& a, const Vec3<W>& b) {
  return {select(condition, a.x(), b.x()), select(condition, a.y(), b.y()),
          select(condition, a.z(), b.z())};
}

namespace detail {

/// Implements `unit` for the zero vector and for squared lengths that leave the range of W.
template <class W>
[[gnu::noinline, gnu::cold]] Vec3<W> unit_rescaled(const Vec3<W>& v, const Mask<W>& ordinary) {
  using std::abs;
  using std::max;
  using std::sqrt;
  const W size = max(abs(v.x()), max(abs(v.y()), abs(v.z())));
  const auto usable = size > W(0);
  const W safe = select(usable, size, W(1));
  const Vec3<W> scaled(v.x() / safe, v.y() / safe, v.z() / safe);
  const W squared = select(usable, W(scaled.squaredNorm()), W(1));
  const Vec3<W> rescaled = scaled * select(usable, W(W(1) / sqrt(squared)), W(0));
  const W as_it_is = select(ordinary, W(v.squaredNorm()), W(1));
  return select<W>(ordinary, Vec3<W>(v * (W(1) / sqrt(as_it_is))), rescaled);
}

}  // namespace detail

/// v divided by its length; the zero vector stays zero. Vectors whose squared length would
/// underflow or overflow are rescaled first, so directions keep their digits over the entire range
/// of W.
template <class W>
[[gnu::always_inline]] inline Vec3<W> unit(const Vec3<W>& v) {
  using std::sqrt;
  using T = Lane<W>;
  // Squares of all components that matter (at least 1/16 of an ulp of the result) must be normal.
  constexpr T smallest = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon() * T(16);
  constexpr T largest = T(1) / smallest;
  const W squared = v.squaredNorm();
  const Mask<W> ordinary = (squared > W(smallest)) & (squared < W(largest));
  if (!all(ordinary)) return detail::unit_rescaled<W>(v, ordinary);
  return v * (W(1) / sqrt(squared));
}

/// Returns number_of(index); the index must be a small integer.
template <std::floating_point W, class NumberOf>
W lookup(W index, NumberOf&& number_of) {
  return number_of(static_cast<std::size_t>(index));
}

/// Rounds towards zero. The number must be small and not negative.
template <std::floating_point W>
W whole(W x) {
  return static_cast<W>(static_cast<int>(x));
}

/// Converts a vector of T to W, with the same vector in all lanes.
template <class W, class T>
Vec3<W> widen(const Vec3<T>& v) {
  return {W(v.x()), W(v.y()), W(v.z())};
}

template <class W, class T>
Mat3<W> widen(const Mat3<T>& m) {
  Mat3<W> wide;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) wide(i, j) = W(m(i, j));
  return wide;
}

/// Returns m v, with the same matrix for all lanes.
template <class W, class T>
Vec3<W> times(const Mat3<T>& m, const Vec3<W>& v) {
  const auto row = [&](int i) {
    return W(m(i, 0)) * v.x() + W(m(i, 1)) * v.y() + W(m(i, 2)) * v.z();
  };
  return {row(0), row(1), row(2)};
}

}  // namespace minkray
