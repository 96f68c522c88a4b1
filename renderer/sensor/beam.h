// SPDX-License-Identifier: MIT
// Beams that have a width: rays spread over a disk, and what they meet as echoes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Directions of the length of `direction` within a cone around it of that full angle (radians):
/// the k-th of n at sqrt((k + 1/2) / n) of the disk's radius, turned by k golden angles (Vogel
/// 1979). The share of them beyond a straight edge differs from the disk's area there by at most
/// n^(-2/3). A single one is the direction itself.
std::vector<Vec3<double>> directions_of_beam(const Vec3<double>& direction, double full_angle,
                                             int count);

/// A hit of one ray of a beam, or all those of an echo together.
struct Met {
  double t = 0, distance = 0;  ///< in lengths of the direction, and in those of the scene
  Vec3<double> normal = Vec3<double>::Zero();
  std::uint32_t instance = 0;
  double t_lo = 0, t_hi = 0;  ///< the proven interval
  bool is_inside = false;
  double incidence = 0;  ///< radians between the ray and the normal
  double intensity = 0;  ///< reflectance cos(incidence) / distance^2, times the share of the beam
};

/// Joins what follows nearer than `resolution` on what is before it: an echo is at the mean
/// distance by intensity, has the sum of the intensities, and the rest of the brightest. Sorted by
/// distance.
std::vector<Met> echoes_of(std::vector<Met> met, double resolution);

}  // namespace minkray
