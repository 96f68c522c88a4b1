// SPDX-License-Identifier: MIT
// Interface of all integrators.
#pragma once

#include <span>

#include "renderer/rays/traced_ray.h"

namespace minkray {

/// Thread-safe.
class LightTransport {
 public:
  virtual ~LightTransport() = default;

  /// Computes what camera rays see, however many; one ray is a span of one. Neighbours in the span
  /// should be neighbours in the picture. The result of a ray does not depend on the others.
  virtual void trace(std::span<TracedRay> rays, RayCounts& counts) const = 0;
};

}  // namespace minkray
