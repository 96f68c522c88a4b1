// SPDX-License-Identifier: MIT
#include "renderer/scene/half_space_json.h"

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/write_member.h"

namespace minkray {

bool is_half_space(const Json& shape) {
  return shape.is_object() && shape.contains("type") && shape["type"].is_string() &&
         shape["type"] == std::string(half_space_name);
}

std::optional<HalfSpaceBody<double>> read_half_space(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes) {
  ObjectReader object(json, path, mistakes);
  object.allow({"type"});
  HalfSpaceBody<double> half_space;
  bool is_good = true;
  if (const Json* written = object.find("normal")) {
    const auto normal = read_vector(*written, object.path("normal"), mistakes);
    is_good = normal.has_value();
    if (normal) half_space.normal = unit(*normal);
    if (normal && half_space.normal.isZero(0)) {
      mistakes.add(object.path("normal"), "must not be zero");
      is_good = false;
    }
  }
  if (const Json* written = object.find("offset")) {
    const auto offset = read_number(*written, object.path("offset"), mistakes);
    is_good &= offset.has_value();
    half_space.offset = offset.value_or(0);
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
