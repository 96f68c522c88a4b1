// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood, "Fast
// Splittable Pseudorandom Number Generators", 2014). Only + - * / and square roots are used on
// them, which IEEE 754 rounds in one way.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace minkray {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  /// Random number in [low, high).
  double within(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }

  Vec3<double> in_cube(double half_size) {
    const double x = within(-half_size, half_size), y = within(-half_size, half_size);
    return {x, y, within(-half_size, half_size)};
  }

  /// A point of the unit sphere, none likelier than another.
  Vec3<double> direction() {
    for (;;) {
      const Vec3<double> v = in_cube(1);
      const double squared = v.squaredNorm();
      if (squared > 1e-4 && squared <= 1) return v / std::sqrt(squared);
    }
  }

  /// A rotation as a unit quaternion (x, y, z, w), none likelier than another: a point of the
  /// sphere in four dimensions.
  std::array<double, 4> rotation() {
    for (;;) {
      std::array<double, 4> q;
      double squared = 0;
      for (double& entry : q) {
        entry = within(-1, 1);
        squared += entry * entry;
      }
      if (!(squared > 1e-4 && squared <= 1)) continue;
      for (double& entry : q) entry /= std::sqrt(squared);
      return q;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace minkray
