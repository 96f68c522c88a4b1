// SPDX-License-Identifier: MIT
// Rays prepared for slab tests against eight boxes of floats. Tests are padded (Ize, "Robust BVH
// Ray Traversal", 2013), so rounding never loses a box that the exact ray meets. The float origin
// is rounded so that near planes come earlier and far planes later. The parameter is measured in
// steps: t is multiplied, and the direction divided, by a power of two, so that the direction's
// largest component is about 1.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/bvh/bvh.h"
#include "core/math/ray.h"

namespace minkray {

/// A ray's numbers for slab tests. In each slab, the ray meets the near plane first and the far
/// plane last.
struct SlabNumbers {
  float origin_near[3], origin_far[3];
  float inverse_near[3], inverse_far[3];  ///< 1 / direction; infinite where a component is 0
  float t_max;                            ///< in steps; negative: the ray meets nothing
  int near[3];                            ///< 0: the lower plane, 1: the upper one
};

/// (plane - origin) * inverse is rounded three times, so its relative error is gamma = 3u / (1 -
/// 3u), where u is half the machine epsilon. Two planes are compared, so the error counts twice,
/// and the product with the padding is rounded once more: 1 + 2 gamma + u < 1 + 4 epsilon.
inline constexpr float slab_padding = 1 + 4 * std::numeric_limits<float>::epsilon();

/// Factor that enlarges a hit's parameter before it limits a ray: the parameter is rounded when it
/// is computed, and again when it is converted to steps.
inline constexpr float hit_padding = 1 + 32 * std::numeric_limits<float>::epsilon();

/// Padding for the absolute error of subnormal numbers.
inline constexpr float slab_tiny = std::numeric_limits<float>::min();

namespace detail {

/// Returns the least float that is not below x. Does not branch: a branch would be unpredictable,
/// since numbers are rounded down or up at random.
inline float float_above(double x) {
  const auto nearest = static_cast<float>(x);
  const std::int32_t step = static_cast<double>(nearest) < x ? 1 : 0;
  // Zero counts as positive. Infinity and NaN remain as they are.
  const std::int32_t bits = nearest == 0 ? 0 : std::bit_cast<std::int32_t>(nearest);
  return std::bit_cast<float>(bits + (bits < 0 ? -step : step));
}
inline float float_below(double x) {
  return -float_above(-x);
}

}  // namespace detail

/// Slab numbers of a ray, and the scale of its parameter.
struct SlabRay {
  SlabNumbers numbers;
  double steps;  ///< number of steps per unit of t

  SlabRay() = default;
  /// Origin and direction must be finite. Components of the direction may be zero (also -0); if all
  /// are zero, the ray is a single point.
  template <class T>
  explicit SlabRay(const Ray<T>& ray) {
    const double largest = static_cast<double>(ray.direction.cwiseAbs().maxCoeff());
    int exponent = 0;
    if (largest > 0 && !(largest >= 0.5 && largest < 2)) std::frexp(largest, &exponent);
    exponent = std::min(exponent, std::numeric_limits<double>::max_exponent - 1);  // finite
    steps = exponent == 0 ? 1 : std::ldexp(1.0, exponent);
    for (int axis = 0; axis < 3; ++axis) {
      const double d = exponent == 0
                           ? static_cast<double>(ray.direction[axis])
                           : std::ldexp(static_cast<double>(ray.direction[axis]), -exponent);
      const bool down = std::signbit(d);
      const double inverse = 1 / d;
      numbers.near[axis] = down ? 1 : 0;
      if constexpr (std::is_same_v<T, float>) {
        numbers.origin_near[axis] = numbers.origin_far[axis] = ray.origin[axis];
      } else {
        // Mirrors the ray so that it goes up, and mirrors the result back, to avoid an
        // unpredictable branch.
        const double turn = std::copysign(1.0, d), o = turn * ray.origin[axis];
        numbers.origin_near[axis] = static_cast<float>(turn) * detail::float_above(o);
        numbers.origin_far[axis] = static_cast<float>(turn) * detail::float_below(o);
      }
      numbers.inverse_near[axis] = numbers.inverse_far[axis] = static_cast<float>(inverse);
      // Inverses too large for float remain finite.
      constexpr float most = std::numeric_limits<float>::max();
      if (d != 0 && !(std::abs(numbers.inverse_near[axis]) <= most))
        numbers.inverse_near[axis] = down ? -most : most;
    }
    numbers.t_max = limit(static_cast<double>(ray.t_max));
  }

  /// Converts t to steps, rounded up. Boxes beyond the result contain no hit at or before t.
  float limit(double t) const { return static_cast<float>(t * steps) * hit_padding + slab_tiny; }
};

}  // namespace minkray
