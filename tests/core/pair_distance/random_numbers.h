// SPDX-License-Identifier: MIT
// Random sizes, directions and turns, the same for the same seed.
#pragma once

#include <random>

#include "core/math/affine.h"

namespace minkray::testing {

class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    return Vec3<double>(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Mat3<double> turn() { return rotation_matrix(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)); }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

}  // namespace minkray::testing
