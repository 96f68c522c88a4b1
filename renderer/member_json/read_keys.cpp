// SPDX-License-Identifier: MIT
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/read_rotation.h"

namespace minkray {

double read_key_time(ObjectReader& key, std::optional<double> before) {
  const Json* time = key.require("time", "the time in seconds");
  if (!time) return 0;
  const auto seconds = read_number(*time, key.path("time"), key.mistakes());
  if (!seconds) return 0;
  if (before && !(*seconds > *before))
    key.mistakes().add(key.path("time"), "must be later than that of the key before (" +
                                             found(*time) + " after " + Json(*before).dump() + ")");
  return *seconds;
}

std::vector<PoseKey> read_keys(const Json& json, const JsonPath& path, Mistakes& mistakes,
                               const Vec3<double>& place) {
  std::vector<PoseKey> keys;
  if (!json.is_array() || json.empty()) {
    mistakes.add(path, "must be a list of at least one key (" + found(json) + ")");
    return keys;
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    ObjectReader object(json[i], path / i, mistakes);
    if (!object.is_object()) continue;
    PoseKey key;
    key.time = read_key_time(object, keys.empty() ? std::nullopt : std::optional(keys.back().time));
    if (const Json* translate = object.find("translate"))
      key.translate = read_vector(*translate, object.path("translate"), mistakes)
                          .value_or(Vec3<double>::Zero());
    if (!place.isZero(0)) key.translate += place;
    if (const Json* rotate = object.find("rotate"))
      if (const auto q = read_rotation(*rotate, object.path("rotate"), mistakes, key.translate))
        key.rotate = unit_quaternion(*q);
    object.finish();
    keys.push_back(key);
  }
  return keys;
}

}  // namespace minkray
