// SPDX-License-Identifier: MIT
#include <cmath>

#include "renderer/json/values.h"
#include "renderer/scene/read_member.h"

namespace minkray {
namespace {

/// Scales any length but zero to unit length; divides by the largest entry first, so that squares
/// stay in range.
std::array<double, 4> unit_quaternion(std::array<double, 4> q) {
  double largest = 0, squares = 0;
  for (const double entry : q) largest = std::max(largest, std::abs(entry));
  for (double& entry : q) {
    entry /= largest;
    squares += entry * entry;
  }
  for (double& entry : q) entry /= std::sqrt(squares);
  return q;
}

}  // namespace

std::vector<PoseKey> read_keys(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  std::vector<PoseKey> keys;
  if (!json.is_array() || json.empty()) {
    mistakes.add(path, "must be a list of at least one key (" + found(json) + ")");
    return keys;
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    ObjectReader object(json[i], path / i, mistakes);
    if (!object.is_object()) continue;
    PoseKey key;
    if (const Json* time = object.require("time", "the time in seconds")) {
      if (const auto seconds = read_number(*time, object.path("time"), mistakes)) {
        key.time = *seconds;
        if (!keys.empty() && !(key.time > keys.back().time))
          mistakes.add(object.path("time"), "must be later than that of the key before (" +
                                                found(*time) + " after " +
                                                Json(keys.back().time).dump() + ")");
      }
    }
    if (const Json* translate = object.find("translate"))
      key.translate = read_vector(*translate, object.path("translate"), mistakes)
                          .value_or(Vec3<double>::Zero());
    if (const Json* rotate = object.find("rotate"))
      if (const auto q = read_quaternion(*rotate, object.path("rotate"), mistakes))
        key.rotate = unit_quaternion(*q);
    object.finish();
    keys.push_back(key);
  }
  return keys;
}

}  // namespace minkray
