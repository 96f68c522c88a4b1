// SPDX-License-Identifier: MIT
#include "renderer/query/read_body.h"

#include "renderer/json/object_reader.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/height_field_json.h"
#include "renderer/scene_json/mesh_json.h"

namespace minkray {

std::optional<QueryBody> read_body(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                   MeshFiles& files) {
  const bool has_mesh = json.contains("mesh"), has_field = json.contains("height_field");
  if (!has_mesh && !has_field) {
    auto shape = read_shape(json, path, mistakes, files);
    if (!shape) return std::nullopt;
    return QueryBody(std::move(*shape));
  }
  ObjectReader body(json, path, mistakes);
  const char* const key = has_mesh ? "mesh" : "height_field";
  const Json& written = *body.find(key);
  for (const char* other : {"type", has_mesh ? "height_field" : "mesh"})
    if (body.find(other))
      mistakes.add(body.path(other), std::string("not allowed together with \"") + key + "\"");
  const auto mesh = has_mesh ? read_mesh(written, body.path(key), mistakes, files).mesh
                             : read_height_field(written, body.path(key), mistakes, files);
  std::optional<Affine<double>> pose(std::in_place);
  if (const Json* const map = body.find("transform")) {
    ObjectReader transform(*map, body.path("transform"), mistakes);
    pose = read_affine(transform);
    transform.finish();
  }
  body.finish();
  if (!mesh || !pose || !mistakes.none()) return std::nullopt;
  return QueryBody(mesh, *pose);
}

}  // namespace minkray
