// SPDX-License-Identifier: MIT
// Footprint of a ray on a surface: a narrow cone around it (Amanatides, "Ray Tracing with Cones",
// 1984), a round form of ray differentials (Igehy, "Tracing Ray Differentials", 1999).
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

/// If it has no width it is a ray: what it meets is looked up at a point.
struct RayCone {
  double width = 0;   ///< the diameter where the ray begins
  double spread = 0;  ///< by how much that grows, over the distance

  /// Further along the ray.
  RayCone at(double distance) const { return {width + spread * distance, spread}; }
  /// Behind a flat surface: eta is the ratio of the refractive indices, behind over in front.
  RayCone refracted(double eta) const { return {width, spread / eta}; }
  /// One of many that share its place.
  RayCone part(double size) const { return {size * width, size * spread}; }
};

/// Footprint of a cone on a surface: the two full axes of an ellipse, along the surface.
using SurfaceFootprint = std::array<Vec3<double>, 2>;

/// The part of a plane that the cone covers, by the plane's unit normal; `width` is that of the
/// cone where it meets the plane. The length is limited at grazing angles.
SurfaceFootprint footprint_of(const RayCone& cone, const Vec3<double>& direction,
                              const Vec3<double>& normal);

}  // namespace minkray
