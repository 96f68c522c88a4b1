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

/// The shape whose cast is replayed: an instance's, or a triangle of an instance that is a mesh.
struct ShownPart {
  std::size_t instance = 0;
  std::uint32_t part = no_part;
};

class SceneCasts {
 public:
  SceneCasts(const Scene& scene, const CastOptions& options);

  SceneAnswer answer(const Ray<double>& ray) const;

  /// The part whose cast is to be shown: the first that the ray meets; else, of up to
  /// `most_looked_at` instances, the one whose miss took most iterations. None: a half-space is
  /// met, which takes no iterations; or a mesh's edge, where a cast at the triangle alone misses;
  /// or nothing is met and there are more instances.
  std::optional<ShownPart> shown(const Ray<double>& ray, const SceneAnswer& answer,
                                 std::size_t most_looked_at) const;

  /// Refers to this.
  PreparedShape shape(const ShownPart& shown) const;
  CastTrace trace(const ShownPart& shown, const Ray<double>& ray) const {
    return trace_ray(shape(shown), ray, world_.options());
  }

  const World& world() const { return world_; }

 private:
  World world_;
};

}  // namespace minkray
