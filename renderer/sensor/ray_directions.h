// SPDX-License-Identifier: MIT
// Directions by angles, in a sensor's frame: x ahead, y left, z up.
#pragma once

#include <cmath>
#include <numbers>

#include "core/math/vec.h"

namespace minkray {

inline double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// Radians: azimuth to the left of x, elevation up from the horizon.
inline Vec3<double> direction_of(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

}  // namespace minkray
