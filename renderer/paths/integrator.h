// SPDX-License-Identifier: MIT
// Light that arrives along a ray, by the requested integrator.
#pragma once

#include <memory>
#include <span>
#include "renderer/paths/integrator_options.h"

#include "renderer/paths/light_transport.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// The kind that is meant: `automatic` is settled by the scene.
IntegratorKind settled(IntegratorKind kind, const Scene& scene);

/// Refers to the scene's world; keeps everything else itself. Any number of threads may call it.
/// Instances of the scene and of the world share their indices.
class Integrator {
 public:
  Integrator(const Scene& scene, const World& world, const IntegratorOptions& options = {});

  /// Same as LightTransport::trace.
  void trace(std::span<TracedRay> rays, RayCounts& counts) const {
    transport_->trace(rays, counts);
  }

 private:
  std::unique_ptr<const LightTransport> transport_;
};

}  // namespace minkray
