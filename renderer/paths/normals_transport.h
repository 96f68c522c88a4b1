// SPDX-License-Identifier: MIT
// Normals as colours, (1 + n) / 2, and white for misses: a quick view of shapes.
#pragma once

#include "renderer/paths/integrator_options.h"
#include "renderer/paths/light_transport.h"

namespace minkray {

class NormalsTransport final : public LightTransport {
 public:
  NormalsTransport(const World& world, const IntegratorOptions& options)
      : world_(world), observer_(options.observer) {}

  void trace(std::span<TracedRay> rays, RayCounts& counts) const override;

 private:
  const World& world_;
  RayObserver* observer_;
};

}  // namespace minkray
