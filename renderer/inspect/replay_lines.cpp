// SPDX-License-Identifier: MIT
#include "renderer/inspect/replay_lines.h"

#include "renderer/inspect/replay.h"
#include "renderer/inspect/shape_mesh.h"
#include "renderer/json/number_json.h"

namespace minkray {

std::string ReplayLines::ray(const SceneCasts& casts, std::size_t solver, std::size_t instance,
                             const PixelRay& pixel) {
  std::string lines;
  const std::uint32_t definition = casts.world().instances().definition_of(instance);
  auto known = shape_of_definition_.find(definition);
  if (known == shape_of_definition_.end()) {
    const PreparedShape shape = casts.shape(instance);
    const Json mesh = mesh_json(shape.inner_shape(), shape.inner_ball(), directions_);
    const auto [at, is_new] = shape_of_mesh_.try_emplace(mesh.dump(), shape_of_mesh_.size());
    if (is_new) {
      const Json line{{"kind", "shape"}, {"shape", at->second}, {"mesh", mesh}};
      lines += line.dump() + "\n";
    }
    known = shape_of_definition_.emplace(definition, at->second).first;
  }
  const Json line{{"kind", "ray"},
                  {"at", Json::array({pixel.x, pixel.y})},
                  {"solver", solver},
                  {"object", instance + 1},
                  {"shape", known->second},
                  {"origin", point_json(pixel.ray.origin)},
                  {"direction", point_json(pixel.ray.direction)},
                  {"cast", replay_json(casts.trace(instance, pixel.ray))}};
  return lines + line.dump() + "\n";
}

}  // namespace minkray
