// SPDX-License-Identifier: MIT
// Random choices of a mutator, from the seed that the fuzzer gives it, and numbers worth trying.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

namespace minkray::fuzz {

class Choice {
 public:
  explicit Choice(unsigned seed) : engine_(seed) {}

  /// 0 .. n - 1; n is not 0.
  std::size_t below(std::size_t n) { return engine_() % n; }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  auto& of(List& list) {
    return list[below(list.size())];
  }

 private:
  std::mt19937 engine_;
};

/// Another number: near the one that was there, or one at which readers and solvers may go wrong.
inline double changed_number(double x, Choice& choice) {
  using Limits = std::numeric_limits<double>;
  static constexpr std::array odd = {
      0.0,           -0.0,          1.0,          -1.0,          2.0,
      3.0,           0.5,           1e-3,         90.0,          255.0,
      256.0,         65536.0,       2147483647.0, 4294967296.0,  9007199254740993.0,
      1e-8,          1e8,           1e20,         1e39,          1e-39,
      1e154,         1e-154,        1e300,        Limits::min(), Limits::denorm_min(),
      Limits::max(), -Limits::max()};
  switch (choice.below(9)) {
    case 0:
      return -x;
    case 1:
      return x * 2;
    case 2:
      return x / 2;
    case 3:
      return x + 1;
    case 4:
      return x - 1;
    case 5:
      return std::nextafter(x, choice.one_in(2) ? Limits::infinity() : -Limits::infinity());
    default:
      return choice.of(odd);
  }
}

}  // namespace minkray::fuzz
