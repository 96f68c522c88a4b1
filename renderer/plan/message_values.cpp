// SPDX-License-Identifier: MIT
#include "renderer/plan/message_values.h"

#include <array>

#include "core/files/text.h"
#include "renderer/import/model/orientation.h"
#include "renderer/json/values.h"
#include "renderer/plan/message_fields.h"

namespace minkray {
namespace {

const Json nothing = Json::array();

/// Reads numbers under those keys, or as many in a list.
template <std::size_t N>
std::array<double, N> read_keys(const Json& json, const std::array<std::string_view, N>& keys,
                                std::array<double, N> values, const JsonPath& path,
                                Mistakes& mistakes) {
  if (json.is_array()) {
    if (const auto read = read_numbers(json, path, mistakes, N))
      std::copy(read->begin(), read->end(), values.begin());
    return values;
  }
  if (!json.is_object()) {
    mistakes.add(path, "must be a list or an object of " + listed(keys) + " (" + found(json) + ")");
    return values;
  }
  for (std::size_t i = 0; i < N; ++i)
    if (const Json* value = json.find(keys[i]))
      values[i] = read_number(*value, path / keys[i], mistakes).value_or(values[i]);
  return values;
}

}  // namespace

const Json* member_of(const Json& json, std::string_view key) {
  const Json* value = json.is_object() ? json.find(key) : nullptr;
  return value && !value->is_null() ? value : nullptr;
}

const Json& list_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes) {
  const Json* value = member_of(json, key);
  if (!value) return nothing;
  if (value->is_array()) return *value;
  mistakes.add(path / key, "must be a list (" + found(*value) + ")");
  return nothing;
}

std::string text_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes) {
  const Json* value = member_of(json, key);
  if (!value) return "";
  // YAML needs no quotes around a name that is a number.
  if (value->is_number()) return value->dump();
  return read_string(*value, path / key, mistakes).value_or("");
}

Vec3<double> read_message_vector(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  check_fields(json, Message::vector, path, mistakes);
  const auto v = read_keys<3>(json, {"x", "y", "z"}, {0, 0, 0}, path, mistakes);
  return {v[0], v[1], v[2]};
}

std::array<double, 4> read_message_quaternion(const Json& json, const JsonPath& path,
                                              Mistakes& mistakes) {
  check_fields(json, Message::quaternion, path, mistakes);
  // The default of w is 0 in ROS 1 and 1 in ROS 2.
  if (json.is_object() && !json.empty() && !json.contains("w"))
    mistakes.add(path / "w", "missing: a quaternion has x, y, z and w");
  return read_keys<4>(json, {"x", "y", "z", "w"}, {0, 0, 0, 0}, path, mistakes);
}

Affine<double> read_message_pose(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  Affine<double> pose;
  if (!json.is_object()) {
    mistakes.add(path,
                 "must be a pose: an object of position and orientation (" + found(json) + ")");
    return pose;
  }
  check_fields(json, Message::pose, path, mistakes);
  for (const std::string_view key : {"position", "translation"})
    if (const Json* value = member_of(json, key))
      pose.translation = read_message_vector(*value, path / key, mistakes);
  for (const std::string_view key : {"orientation", "rotation"})
    if (const Json* value = member_of(json, key)) {
      const auto q = read_message_quaternion(*value, path / key, mistakes);
      pose.linear = rotation_of_quaternion(q[0], q[1], q[2], q[3]);
    }
  return pose;
}

std::optional<double> read_message_duration(const Json& json, const JsonPath& path,
                                            Mistakes& mistakes) {
  if (json.is_number()) return read_number(json, path, mistakes);
  if (json.is_object()) {
    constexpr std::array<std::string_view, 4> keys = {"secs", "nsecs", "sec", "nanosec"};
    for (const Json::Member& member : json.members())
      if (std::find(keys.begin(), keys.end(), member.key) == keys.end()) {
        mistakes.add(path / member.key,
                     "unknown key: a duration is {secs, nsecs}, {sec, nanosec} or a number");
        return std::nullopt;
      }
    const auto t = read_keys<4>(json, keys, {0, 0, 0, 0}, path, mistakes);
    return t[0] + t[2] + 1e-9 * (t[1] + t[3]);
  }
  mistakes.add(
      path, "must be a duration: {secs, nsecs}, {sec, nanosec} or seconds (" + found(json) + ")");
  return std::nullopt;
}

std::vector<double> read_number_list(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (json.is_null()) return {};
  if (!json.is_array()) {
    mistakes.add(path, "must be a list of numbers (" + found(json) + ")");
    return {};
  }
  return read_numbers(json, path, mistakes, json.size()).value_or(std::vector<double>());
}

std::vector<std::string> read_name_list(const Json& json, const JsonPath& path,
                                        Mistakes& mistakes) {
  std::vector<std::string> names;
  if (json.is_null()) return names;
  if (!json.is_array()) mistakes.add(path, "must be a list of names (" + found(json) + ")");
  for (std::size_t i = 0; json.is_array() && i < json.size(); ++i)
    names.push_back(json[i].is_number() ? json[i].dump()
                                        : read_string(json[i], path / i, mistakes).value_or(""));
  return names;
}

}  // namespace minkray
