// SPDX-License-Identifier: MIT
// Number of rays of each kind in a picture, and their cost. Sums over tiles.
#pragma once

#include <cstdint>

#include "core/world/world.h"

namespace minkray {

struct RayCounts {
  std::uint64_t camera = 0;
  std::uint64_t shadow = 0;     ///< towards directional and point lights
  std::uint64_t ambient = 0;    ///< the last of a path, towards the environment: any hit will do
  std::uint64_t scattered = 0;  ///< from a diffuse surface to the next one
  std::uint64_t mirrored = 0;
  std::uint64_t background = 0;   ///< camera rays that met nothing
  std::uint64_t from_inside = 0;  ///< camera rays that began in a shape, and see black
  QueryCounts work;

  std::uint64_t total() const { return camera + shadow + ambient + scattered + mirrored; }

  RayCounts& operator+=(const RayCounts& other) {
    camera += other.camera;
    shadow += other.shadow;
    ambient += other.ambient;
    scattered += other.scattered;
    mirrored += other.mirrored;
    background += other.background;
    from_inside += other.from_inside;
    work += other.work;
    return *this;
  }
};

}  // namespace minkray
