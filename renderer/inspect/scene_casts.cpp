// SPDX-License-Identifier: MIT
#include "renderer/inspect/scene_casts.h"

#include "renderer/film/render.h"

namespace minkray {

SceneCasts::SceneCasts(const Scene& scene, const CastOptions& options)
    : world_(make_world(scene, options)) {}

SceneAnswer SceneCasts::answer(const Ray<double>& ray) const {
  SceneAnswer answer;
  answer.hit = world_.closest_hit({ray, no_instance, 0, camera_rays}, answer.work);
  return answer;
}

std::optional<std::size_t> SceneCasts::shown(const Ray<double>& ray, const SceneAnswer& answer,
                                             std::size_t most_looked_at) const {
  const Instances& instances = world_.instances();
  if (answer.hit.found()) {
    if (!instances.has_shape(answer.hit.instance)) return std::nullopt;
    return answer.hit.instance;
  }
  if (instances.size() > most_looked_at) return std::nullopt;
  std::optional<std::size_t> hardest;
  int iterations = -1;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!instances.has_shape(i)) continue;
    const CastResult<double> result = cast_ray(instances.at(i), ray, world_.options());
    if (result.iterations <= iterations) continue;
    hardest = i;
    iterations = result.iterations;
  }
  return hardest;
}

}  // namespace minkray
