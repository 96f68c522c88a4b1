// SPDX-License-Identifier: MIT
#include "renderer/json/object_reader.h"

#include <algorithm>

#include "renderer/json/closest_word.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

/// Longer lists are cut.
constexpr std::size_t most_names = 40;

}  // namespace

std::string suggestion(std::string_view written, const std::vector<std::string>& names) {
  if (names.empty()) return "none is known here";
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

bool ObjectReader::finish() {
  if (!is_object_) return false;
  bool all_known = true;
  for (const Json::Member& member : json_.members()) {
    if (std::find(known_.begin(), known_.end(), member.key) == known_.end()) {
      mistakes_.add(path_ / member.key, "unknown key (" + suggestion(member.key, known_) + ")");
      all_known = false;
    }
  }
  return all_known;
}

}  // namespace minkray
