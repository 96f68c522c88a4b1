// SPDX-License-Identifier: MIT
// Distance of a ray from a shape's silhouette, from supports alone.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::testing {

/// Depth of the ray within the shape's shadow along the ray; negative: outside of it.
inline double room_in_shadow(const Shape& shape, const Ray<double>& ray) {
  const Vec3<double> r = ray.direction.normalized(), a = r.unitOrthogonal(), b = r.cross(a);
  const Vec3<double> near = ray.origin + (shape.support(r) - ray.origin).dot(r) * r;
  const auto room = [&](double angle) {
    const Vec3<double> u = std::cos(angle) * a + std::sin(angle) * b;
    return u.dot(shape.support(u) - near);
  };
  constexpr int samples = 256;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * std::numbers::pi * i / samples, value = room(angle);
    if (value < least) {
      least = value;
      best = angle;
    }
  }
  for (double step = 2 * std::numbers::pi / samples; step > 1e-16; step /= 1.5) {
    for (const double angle : {best - step, best + step}) {
      if (const double value = room(angle); value < least) {
        least = value;
        best = angle;
      }
    }
  }
  return least;
}

}  // namespace minkray::testing
