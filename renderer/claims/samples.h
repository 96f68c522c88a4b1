// SPDX-License-Identifier: MIT
// Random rays, shapes and numbers for the claims, from fixed seeds.
#pragma once

#include <cstdio>
#include <random>
#include <string>

#include "core/math/affine.h"
#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray {

class Samples {
 public:
  explicit Samples(unsigned seed) : engine_(seed) {}

  /// Same on every machine, which std::uniform_real_distribution does not promise.
  double in(double low, double high) {
    constexpr double scale = 1.0 / 18446744073709551616.0;
    return low + (high - low) * (static_cast<double>(engine_()) * scale);
  }

  Vec3<double> in_cube(double half) {
    const double x = in(-half, half), y = in(-half, half), z = in(-half, half);
    return {x, y, z};
  }

  Vec3<double> in_ball(double radius) {
    for (;;)
      if (const Vec3<double> p = in_cube(radius); p.norm() <= radius) return p;
  }

  Mat3<double> rotation() {
    for (;;) {
      const double x = in(-1, 1), y = in(-1, 1), z = in(-1, 1), w = in(-1, 1);
      const double length = x * x + y * y + z * z + w * w;
      if (length > 0.01 && length < 1) return rotation_matrix(x, y, z, w);
    }
  }

  /// Ray from 2 to 5 radii away towards a point within 1.05 radii: nine of ten hit the ball.
  Ray<double> ray_at_ball(double radius) {
    const Vec3<double> origin = unit(in_ball(1)) * (radius * in(2, 5));
    const Vec3<double> target = in_ball(1.05 * radius);
    return {origin, unit<double>(target - origin)};
  }

  Hull hull(int points) {
    std::vector<Vec3<double>> list;
    for (int i = 0; i < points; ++i) list.push_back(unit(in_ball(1)));
    return {PointCloud(std::move(list))};
  }

 private:
  std::mt19937_64 engine_;
};

/// printf into a string.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[400];
  const int length = std::snprintf(text, sizeof text, format, values...);
  return std::string(text, static_cast<std::size_t>(std::min(length, 399)));
}

}  // namespace minkray
