// SPDX-License-Identifier: MIT
// Casts single rays at a scene: the result as in pictures, and the one cast to replay with all of
// its iterations, as chosen by `minkray trace`.
#pragma once

#include <optional>

#include "core/world/world.h"
#include "renderer/paper/trace.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Hit of a ray through the scene, and its cost.
struct SceneAnswer {
  WorldHit hit;
  QueryCounts work;
};

class SceneCasts {
 public:
  SceneCasts(const Scene& scene, const CastOptions& options);

  SceneAnswer answer(const Ray<double>& ray) const;

  /// The instance whose cast is to be shown: the first that the ray meets; else, of up to
  /// `most_looked_at` instances, the one whose miss took most iterations. None: a half-space is
  /// met, which takes no iterations, or nothing is and there are more instances.
  std::optional<std::size_t> shown(const Ray<double>& ray, const SceneAnswer& answer,
                                   std::size_t most_looked_at) const;

  /// Refers to this.
  PreparedShape shape(std::size_t instance) const { return world_.instances().at(instance); }
  CastTrace trace(std::size_t instance, const Ray<double>& ray) const {
    return trace_ray(shape(instance), ray, world_.options());
  }

  const World& world() const { return world_; }

 private:
  World world_;
};

}  // namespace minkray
