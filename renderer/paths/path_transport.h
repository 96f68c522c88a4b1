// SPDX-License-Identifier: MIT
// Path tracing. At each vertex light is sampled in two ways, towards the lights and by the BSDF,
// weighted by the balance heuristic (Veach and Guibas, "Optimally Combining Sampling Techniques",
// 1995). Russian roulette ends paths of little weight without bias.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "renderer/lights/emitters.h"
#include "renderer/lights/lights.h"
#include "renderer/paths/light_transport.h"
#include "renderer/paths/wave_casts.h"
#include "renderer/surfaces/scene_surfaces.h"

namespace minkray {

/// Refers to the world. Paths of a wave continue together, step by step; each has its own random
/// numbers and sums, so that the result does not depend on which go together.
class PathTransport final : public LightTransport {
 public:
  PathTransport(const Scene& scene, const World& world, const IntegratorOptions& options);
  ~PathTransport() override;

  void trace(std::span<TracedRay> rays, RayCounts& counts) const override;

 private:
  struct Path;
  struct Point;
  struct Arriving;
  struct ShadowRays;
  struct WaveMemory;
  class Wave;

  static Emitters::RadianceOfPart radiance_of_part(const SceneSurfaces& surfaces);
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
  /// Memory of waves that have ended, for the next ones.
  mutable std::vector<std::unique_ptr<WaveMemory>> spare_;
  mutable std::mutex spare_lock_;
};

}  // namespace minkray
