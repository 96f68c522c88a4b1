// SPDX-License-Identifier: MIT
// Path tracing: all light there is, by paths that are scattered, mirrored and refracted as often as
// it takes. At each point light is looked for in two ways, towards the lights and along the
// direction that the surface draws; what both can find is weighed by the balance heuristic (Veach
// and Guibas, "Optimally Combining Sampling Techniques", 1995). Paths that carry little end by
// chance (Russian roulette), so that nothing is lost on average.
#pragma once

#include <vector>

#include "renderer/light/emitters.h"
#include "renderer/light/light_transport.h"
#include "renderer/light/lights.h"
#include "renderer/light/scene_surfaces.h"
#include "renderer/light/wave_casts.h"

namespace minkray {

/// Refers to the world. Paths of a wave go on together, step by step; each has its own random
/// numbers and sums, so that it does not matter which go together.
class PathTransport final : public LightTransport {
 public:
  PathTransport(const Scene& scene, const World& world, const IntegratorOptions& options);

  void trace(std::span<TracedRay> rays, RayCounts& counts) const override;

 private:
  struct Path;
  struct Point;
  struct Arriving;
  struct ShadowRays;
  class Wave;

  bool is_flat_sheet(std::uint32_t instance) const {
    return !is_flat_sheet_.empty() && is_flat_sheet_[instance];
  }

  const World& world_;
  WaveCasts casts_;
  IntegratorOptions options_;
  SceneSurfaces surfaces_;
  Emitters emitters_;
  Lights lights_;
  EnvironmentSource background_;
  bool background_is_sky_;
  std::vector<bool> is_flat_sheet_;  ///< by instance, if there are sheets
};

}  // namespace minkray
