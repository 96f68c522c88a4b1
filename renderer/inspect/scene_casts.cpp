// SPDX-License-Identifier: MIT
#include "renderer/inspect/scene_casts.h"

#include "core/derived/triangle_of.h"
#include "renderer/film/render.h"

namespace minkray {

SceneCasts::SceneCasts(const Scene& scene, const CastOptions& options)
    : world_(make_world(scene, options)) {}

SceneAnswer SceneCasts::answer(const Ray<double>& ray) const {
  SceneAnswer answer;
  answer.hit = world_.closest_hit({ray, no_instance, 0, camera_rays}, answer.work);
  return answer;
}

PreparedShape SceneCasts::shape(const ShownPart& shown) const {
  const Instances& instances = world_.instances();
  if (shown.part == no_part) return instances.at(shown.instance);
  const PosedMesh& posed = instances.mesh_of(shown.instance);
  const TriangleMesh& mesh = *posed.mesh;
  return PreparedShape(triangle_of(mesh.corner(shown.part, 0), mesh.corner(shown.part, 1),
                                   mesh.corner(shown.part, 2)),
                       posed.pose);
}

std::optional<ShownPart> SceneCasts::shown(const Ray<double>& ray, const SceneAnswer& answer,
                                           std::size_t most_looked_at) const {
  const Instances& instances = world_.instances();
  if (answer.hit.found()) {
    const ShownPart met{answer.hit.instance, answer.hit.part};
    if (instances.is_half_space(met.instance)) return std::nullopt;
    if (met.part != no_part && !cast_ray(shape(met), ray, world_.options()).found())
      return std::nullopt;
    return met;
  }
  if (instances.size() > most_looked_at) return std::nullopt;
  std::optional<ShownPart> hardest;
  int iterations = -1;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!instances.has_shape(i)) continue;
    const CastResult<double> result = cast_ray(instances.at(i), ray, world_.options());
    if (result.iterations <= iterations) continue;
    hardest = ShownPart{i};
    iterations = result.iterations;
  }
  return hardest;
}

}  // namespace minkray
