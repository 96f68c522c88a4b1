// SPDX-License-Identifier: MIT
#include "renderer/rays/ray_cone.h"

#include <algorithm>
#include <cmath>

#include "renderer/rays/frame.h"

namespace minkray {

SurfaceFootprint footprint_of(const RayCone& cone, const Vec3<double>& direction,
                              const Vec3<double>& normal) {
  const double width = std::abs(cone.width);
  if (!(width > 0)) return {Vec3<double>::Zero(), Vec3<double>::Zero()};
  // A ray that is closer to the surface than this, by its cosine, counts as lying in it.
  constexpr double least_cosine = 1e-6;
  const Vec3<double> across = normal.cross(direction);
  const double sine = across.norm();
  if (!(sine > least_cosine)) {
    const Frame frame(normal);
    return {width * frame.x, width * frame.y};
  }
  const double cosine = std::max(std::abs(normal.dot(direction)), least_cosine);
  return {width / sine * across, width / (sine * cosine) * normal.cross(across)};
}

}  // namespace minkray
