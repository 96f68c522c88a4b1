// SPDX-License-Identifier: MIT
#include "renderer/json/object_reader.h"

#include <algorithm>

#include "renderer/json/closest_word.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

/// Longer lists are cut.
constexpr std::size_t most_names = 40;

/// Keys of other programs and formats, and the one here.
struct KeyElsewhere {
  std::string_view written, name;
};
constexpr KeyElsewhere keys_elsewhere[] = {
    {"keyframes", "keys"},
    {"animation", "keys"},
    {"position", "translate"},
    {"location", "translate"},
    {"translation", "translate"},
    {"rotation", "rotate"},
    {"quaternion", "rotate"},
    {"rotate_degrees", "rotate"},
    {"euler", "rotate"},
    {"size", "half_extents"},
    {"dimensions", "half_extents"},
    {"diameter", "radius"},
    {"height", "half_height"},
    {"length", "half_height"},
    {"center", "translate"},
    {"geometry", "shape"},
    {"target", "look_at"},
    {"lookat", "look_at"},
    {"fov", "fov_y_degrees"},
    {"t", "time"},
    {"frame", "time"},
    {"ior", "index_of_refraction"},
    {"colour", "color"},
    {"albedo", "color"},
    {"rgb", "color"},
    {"children", "objects"},
    {"includes", "include"},
};

}  // namespace

std::string suggestion(std::string_view written, const std::vector<std::string>& names) {
  if (names.empty()) return "none is defined";
  if (const auto closest = closest_word(written, names))
    return "did you mean \"" + *closest + "\"?";
  std::string text = "known here:";
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
    text += (i == 0 ? " " : ", ") + names[i];
  if (names.size() > most_names)
    text += " and " + std::to_string(names.size() - most_names) + " more";
  return text;
}

ObjectReader::ObjectReader(const Json& json, JsonPath path, Mistakes& mistakes)
    : json_(json), path_(std::move(path)), mistakes_(mistakes), is_object_(json.is_object()) {
  if (!is_object_) mistakes_.add(path_, "must be an object (" + found(json) + ")");
}

const Json* ObjectReader::find(std::string_view key) {
  allow({key});
  if (!is_object_) return nullptr;
  return json_.find(key);
}

const Json* ObjectReader::require(std::string_view key, std::string_view expected) {
  const Json* value = find(key);
  if (!value && is_object_) {
    mistakes_.add(path_ / key, "missing: must be " + std::string(expected));
  }
  return value;
}

void ObjectReader::allow(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  }
}

std::string ObjectReader::key_meant(std::string_view written) const {
  for (const KeyElsewhere& one : keys_elsewhere)
    if (one.written == written && std::ranges::find(known_, one.name) != known_.end())
      return "did you mean \"" + std::string(one.name) + "\"?";
  return suggestion(written, known_);
}

bool ObjectReader::finish() {
  if (!is_object_) return false;
  bool all_known = true;
  for (const Json::Member& member : json_.members()) {
    if (std::find(known_.begin(), known_.end(), member.key) == known_.end()) {
      mistakes_.add(path_ / member.key, "unknown key (" + key_meant(member.key) + ")");
      all_known = false;
    }
  }
  return all_known;
}

}  // namespace minkray
