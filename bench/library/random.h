// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood, "Fast
// Splittable Pseudorandom Number Generators", 2014).
#pragma once

#include <cstdint>

#include "vec.h"

namespace bench {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  /// Uniform in [low, high).
  double within(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  Vec in_cube(double half_size) {
    const double x = within(-half_size, half_size), y = within(-half_size, half_size);
    return {x, y, within(-half_size, half_size)};
  }
  /// Uniform on the unit sphere.
  Vec direction() {
    for (;;) {
      const Vec v = in_cube(1);
      const double squared = dot(v, v);
      if (squared > 1e-4 && squared <= 1) return (1 / std::sqrt(squared)) * v;
    }
  }
  /// Uniform over all rotations.
  mk::Quaternion rotation() {
    for (;;) {
      mk::Quaternion q;
      double squared = 0;
      for (double* entry : {&q.x, &q.y, &q.z, &q.w}) {
        *entry = within(-1, 1);
        squared += *entry * *entry;
      }
      if (squared > 1e-4 && squared <= 1) return q;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace bench
