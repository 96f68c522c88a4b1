// SPDX-License-Identifier: MIT
// Numbers and lists of them as JSON and as JSON Schema.
#include <cmath>

#include "core/support/named_kind.h"
#include "renderer/json/limits.h"
#include "renderer/member_json/member_codec.h"

namespace minkray {

Json to_json(const Vec3<double>& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

std::string_view name_of(Unit unit) {
  return name_at({"", "length", "degrees"}, unit);
}

Json schema_of_list(const Json& item, std::size_t count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

Json schema_of_number(Range range) {
  const Limits& limits = limits_of(range);
  Json schema = {{"type", "number"}};
  const auto add = [&](const char* key, const char* key_of_excluded, double limit) {
    if (!std::isfinite(limit)) return;
    // Small whole numbers are written without a fraction.
    const int whole = limit < 1e9 ? static_cast<int>(limit) : 0;
    schema[limits.are_excluded ? key_of_excluded : key] =
        whole == limit ? Json(whole) : Json(limit);
  };
  add("minimum", "exclusiveMinimum", limits.least);
  add("maximum", "exclusiveMaximum", limits.most);
  return schema;
}

}  // namespace minkray
