// SPDX-License-Identifier: MIT
// Directions from angles in a sensor's frame (x ahead, y left, z up), and perpendicular directions.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "core/math/vec.h"

namespace minkray {

inline double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// Angles in radians: azimuth to the left of x, elevation up from the horizon.
inline Vec3<double> direction_of(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// Returns two unit vectors that are perpendicular to the given one and to each other.
inline std::array<Vec3<double>, 2> across(const Vec3<double>& along) {
  const Vec3<double> helper =
      std::abs(along.x()) < 0.5 ? Vec3<double>(1, 0, 0) : Vec3<double>(0, 1, 0);
  const Vec3<double> u = unit<double>(helper - along.dot(helper) * along);
  return {u, along.cross(u)};
}

}  // namespace minkray
