// SPDX-License-Identifier: MIT
// Numbers from bytes: what a fuzzer's input is read as. Bytes that are missing are zero, so every
// input is a whole one.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "core/math/vec.h"

namespace minkray::fuzz {

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }
  unsigned byte() {
    if (left_.empty()) return 0;
    const auto first = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return first;
  }
  /// 0 .. n - 1, n at most 256.
  int below(int n) { return static_cast<int>(byte()) % n; }
  /// In [0, 1), in steps of 2^-16.
  double fraction() {
    // One after the other: in which order operands are evaluated differs between compilers.
    const unsigned high = byte(), low = byte();
    return (high * 256 + low) * 0x1p-16;
  }

  /// A length that is not negative: mostly near 1, some whole, zero, denormal, or anywhere from
  /// 1e-30 to 1e30. Wild or not, it is in the range in which casts are promised to be right.
  template <class T>
  T length(bool wild) {
    const unsigned kind = byte();
    if (kind < 128 || (!wild && kind < 192)) return scaled<T>(0.5, 9, 5);
    if (kind < 208) return T(below(4));
    if (kind < 216) return T(0);
    if (!wild) return T(1) / T(1 + below(16));
    if (kind < 220) return std::numeric_limits<T>::denorm_min() * T(1 + byte());
    return scaled<T>(1, 200, 100);
  }
  template <class T>
  T positive(bool wild) {
    const T size = length<T>(wild);
    return size > T(0) ? size : T(1);
  }
  template <class T>
  T coordinate(bool wild) {
    const T size = length<T>(wild);
    return byte() & 1 ? -size : size;
  }
  template <class T>
  Vec3<T> point(bool wild) {
    const T x = coordinate<T>(wild), y = coordinate<T>(wild), z = coordinate<T>(wild);
    return {x, y, z};
  }

 private:
  template <class T>
  T scaled(double least, int exponents, int middle) {
    const double mantissa = least + fraction();
    return T(std::ldexp(mantissa, below(exponents) - middle));
  }

  std::string_view left_;
};

}  // namespace minkray::fuzz
