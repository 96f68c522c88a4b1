// SPDX-License-Identifier: MIT
// Input of integrators: a ray, and where its light is added.
#pragma once

#include "renderer/rays/ray_cone.h"
#include "renderer/rays/ray_counts.h"
#include "renderer/rays/sampler.h"
#include "renderer/scene/materials.h"

namespace minkray {

/// Ray with its light.
struct TracedRay {
  Ray<double> ray;  ///< of unit direction
  Sampler sampler;
  Colour radiance = Colour::Zero();
  Colour direct = Colour::Zero();    ///< of it: what was scattered at most once
  bool met = false;                  ///< true if it met an object
  double time = 0;                   ///< while the shutter is open: from 0 to 1
  std::uint32_t left = no_instance;  ///< the instance that it leaves
  RayCone cone = {};                 ///< footprint for textures
};

/// No more rays can be traced together.
inline constexpr int most_in_ray_group = 4096;

}  // namespace minkray
