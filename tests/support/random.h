// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine and with every standard library.
#pragma once

#include <cstdint>
#include <random>

#include "core/math/vec.h"

namespace minkray::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// 0 .. n - 1.
  int below(int n) { return static_cast<int>(uniform() * n); }
  Vec3<double> in_cube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  Vec3<double> direction() {
    for (;;) {
      const Vec3<double> d = in_cube();
      if (const double squared = d.squaredNorm(); squared <= 1 && squared > 0.01)
        return d / std::sqrt(squared);
    }
  }
  /// A turn about a random axis by a random angle.
  Mat3<double> rotation() {
    return Eigen::AngleAxis<double>(uniform(0, 6.28), direction()).toRotationMatrix();
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace minkray::testing
