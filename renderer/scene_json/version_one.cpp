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
  if (json.is_object() && json.find(key))
    mistakes.add(path / key, std::string("unknown key (it is one of version 2") + advice);
}

}  // namespace

void refuse_version_two(const Json& scene, Mistakes& mistakes) {
  if (!scene.is_object()) return;
  for (const auto& [of, in, key] : later_keys) {
    if (of == LaterKey::Of::file) {
      refuse_key(scene, key, JsonPath(), mistakes);
    } else if (const Json* holder = scene.find(in)) {
      if (of == LaterKey::Of::object) refuse_key(*holder, key, JsonPath() / in, mistakes);
      for (std::size_t i = 0; of == LaterKey::Of::items && holder->is_array() && i < holder->size();
           ++i)
        refuse_key((*holder)[i], key, JsonPath() / in / i, mistakes);
    }
  }
  refuse_values(scene, JsonPath(), mistakes);
}

}  // namespace minkray
