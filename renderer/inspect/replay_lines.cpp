// SPDX-License-Identifier: MIT
#include "renderer/inspect/replay_lines.h"

#include <algorithm>

#include "renderer/inspect/body_mesh.h"
#include "renderer/inspect/replay.h"
#include "renderer/inspect/shape_mesh.h"
#include "renderer/json/number_json.h"

namespace minkray {

std::size_t ReplayLines::number_of(const Json& mesh, std::string& lines) {
  const auto [at, is_new] = shape_of_mesh_.try_emplace(mesh.dump(), shape_of_mesh_.size());
  if (is_new) {
    const Json line{{"kind", "shape"}, {"shape", at->second}, {"mesh", mesh}};
    lines += line.dump() + "\n";
  }
  return at->second;
}

std::size_t ReplayLines::body_of(const SceneCasts& casts, const ShownPart& part,
                                 std::string& lines) {
  const Instances& instances = casts.world().instances();
  const TriangleMesh& mesh = *instances.mesh_of(part.instance).mesh;
  const auto [at, is_new] = bodies_.try_emplace(&mesh, bodies_.size());
  if (is_new) {
    const std::size_t most =
        std::min(body_triangles_of_mesh, body_triangles_of_page / instances.meshes().size());
    const Json line{{"kind", "body"}, {"body", at->second}, {"mesh", body_json(mesh, most)}};
    lines += line.dump() + "\n";
  }
  return at->second;
}

std::size_t ReplayLines::shape_of(const SceneCasts& casts, const ShownPart& part,
                                  std::string& lines) {
  const Instances& instances = casts.world().instances();
  if (part.part != no_part) {
    const TriangleMesh& mesh = *instances.mesh_of(part.instance).mesh;
    const PreparedShape triangle = casts.shape(part);
    // The middle of its ball, in the mesh's frame.
    const Vec3<double> middle = PreparedShape(triangle.definition().original_shape()).centre();
    Json json = triangle_json(mesh, part.part, middle, triangle.inner_ball().radius);
    json["body"] = body_of(casts, part, lines);
    json["at"] = point_json(middle);
    return number_of(json, lines);
  }
  const std::uint32_t definition = instances.definition_of(part.instance);
  auto known = shape_of_definition_.find(definition);
  if (known == shape_of_definition_.end()) {
    const PreparedShape shape = casts.shape(part);
    const Json mesh = mesh_json(shape.inner_shape(), shape.inner_ball(), directions_);
    known = shape_of_definition_.emplace(definition, number_of(mesh, lines)).first;
  }
  return known->second;
}

std::string ReplayLines::ray(const SceneCasts& casts, std::size_t solver, const ShownPart& part,
                             const PixelRay& pixel) {
  std::string lines;
  const std::size_t shape = shape_of(casts, part, lines);
  Json line{{"kind", "ray"},
            {"at", Json::array({pixel.x, pixel.y})},
            {"solver", solver},
            {"object", part.instance + 1},
            {"shape", shape},
            {"origin", point_json(pixel.ray.origin)},
            {"direction", point_json(pixel.ray.direction)},
            {"cast", replay_json(casts.trace(part, pixel.ray))}};
  if (part.part != no_part) line["triangle"] = part.part;
  return lines + line.dump() + "\n";
}

}  // namespace minkray
