// SPDX-License-Identifier: MIT
#include "renderer/scene_json/version_one.h"

#include <algorithm>
#include <array>

#include "renderer/json/values.h"
#include "renderer/member_json/read_colour.h"

namespace minkray {
namespace {

constexpr const char* advice = "; write \"version\": 2 for it)";

/// Texts of these keys are no colours.
constexpr std::array<std::string_view, 7> keys_of_texts = {
    "name", "material", "description", "focus_on", "file", "time", "$schema"};

void refuse_values(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (json.is_array()) {
    // Lists of numbers may have millions of items.
    for (std::size_t i = 0; i < json.size(); ++i)
      if (json[i].is_object()) refuse_values(json[i], path / i, mistakes);
    return;
  }
  for (const auto& [key, value] : json.members()) {
    if (key == "rotate" && value.is_object())
      mistakes.add(path / key, "must be a quaternion [x, y, z, w] (" + found(value) + advice);
    else if (value.is_string() && colour_of_hex(value.text()) &&
             std::ranges::find(keys_of_texts, key) == keys_of_texts.end())
      mistakes.add(path / key, "must be a list of 3 numbers (" + found(value) + advice);
    else if (value.is_object() || value.is_array())
      refuse_values(value, path / key, mistakes);
  }
}

void refuse_key(const Json& json, std::string_view key, const JsonPath& path, Mistakes& mistakes) {
  if (json.find(key))
    mistakes.add(path / key, std::string("unknown key (it is one of version 2") + advice);
}

void refuse_in_items(const Json& scene, std::string_view list,
                     std::initializer_list<std::string_view> keys, Mistakes& mistakes) {
  const Json* items = scene.find(list);
  if (!items || !items->is_array()) return;
  for (std::size_t i = 0; i < items->size(); ++i)
    for (const std::string_view key : keys)
      if ((*items)[i].is_object()) refuse_key((*items)[i], key, JsonPath() / list / i, mistakes);
}

}  // namespace

void refuse_version_two(const Json& scene, Mistakes& mistakes) {
  if (!scene.is_object()) return;
  refuse_key(scene, "include", JsonPath(), mistakes);
  if (const Json* camera = scene.find("camera"); camera && camera->is_object())
    refuse_key(*camera, "keys", JsonPath() / "camera", mistakes);
  refuse_in_items(scene, "lights", {"keys"}, mistakes);
  refuse_in_items(scene, "materials", {"keys"}, mistakes);
  refuse_in_items(scene, "objects", {"include", "objects", "color", "pivot"}, mistakes);
  refuse_values(scene, JsonPath(), mistakes);
}

}  // namespace minkray
