// SPDX-License-Identifier: MIT
#include "renderer/scene_json/half_space_json.h"

#include "renderer/json/object_reader.h"
#include "renderer/member_json/member_codec.h"

namespace minkray {

bool is_half_space(const Json& shape) {
  return shape.is_object() && shape.contains("type") && shape["type"].is_string() &&
         shape["type"] == std::string(half_space_name);
}

std::optional<HalfSpaceBody<double>> read_half_space(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes, MeshFiles& meshes) {
  ObjectReader object(json, path, mistakes);
  object.allow({"type"});
  HalfSpaceDescription written;
  bool is_good = read_members(object, written, meshes);
  HalfSpaceBody<double> half_space;
  half_space.normal = unit(written.normal);
  half_space.offset = written.offset;
  if (half_space.normal.isZero(0)) {
    mistakes.add(object.path("normal"), "must not be zero");
    is_good = false;
  }
  return object.finish() && is_good ? std::optional(half_space) : std::nullopt;
}

Json write_half_space(const HalfSpaceBody<double>& half_space) {
  Json json = {{"type", std::string(half_space_name)}};
  json["normal"] = to_json(half_space.normal);
  json["offset"] = half_space.offset;
  return json;
}

}  // namespace minkray
