// SPDX-License-Identifier: MIT
// Beams with a width: rays spread over a disk, whose hits are grouped to echoes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Directions with the length of `direction` in a cone around it with that full angle (radians).
/// The k-th of n is at sqrt((k + 1/2) / n) of the disk's radius, turned by k golden angles (Vogel
/// 1979). The share of directions beyond a straight edge differs from the disk's area there by at
/// most n^(-2/3). A single direction is `direction` itself.
std::vector<Vec3<double>> directions_of_beam(const Vec3<double>& direction, double full_angle,
                                             int count);

/// A hit of one ray of a beam, or all hits of one echo joined.
struct Met {
  double t = 0, distance = 0;  ///< in units of the direction's length; in units of the scene
  Vec3<double> normal = Vec3<double>::Zero();
  std::uint32_t instance = 0;
  double t_lo = 0, t_hi = 0;  ///< proven interval
  bool is_inside = false;
  double incidence = 0;  ///< angle in radians between the ray and the normal
  double intensity = 0;  ///< reflectance cos(incidence) / distance^2, times the share of the beam
};

/// Sorts hits by distance and joins those nearer than `resolution` to the hit before them. An echo
/// has the mean distance weighted by intensity, the sum of the intensities, and all else from the
/// brightest hit.
std::vector<Met> echoes_of(std::vector<Met> met, double resolution);

}  // namespace minkray
