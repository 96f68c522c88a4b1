// SPDX-License-Identifier: MIT
// Checks that a scene file of version 1 uses no later keys, which programs for version 1 cannot
// read.
#pragma once

#include <string_view>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// A key of version 2: of the file itself, of an object in it, or of the items of a list in it.
struct LaterKey {
  enum class Of : unsigned char { file, object, items };
  Of of;
  std::string_view in;  ///< name of the object or list
  std::string_view key;
};

inline constexpr LaterKey later_keys[] = {
    {LaterKey::Of::file, "", "include"},         {LaterKey::Of::object, "camera", "keys"},
    {LaterKey::Of::items, "lights", "keys"},     {LaterKey::Of::items, "materials", "keys"},
    {LaterKey::Of::items, "objects", "include"}, {LaterKey::Of::items, "objects", "objects"},
    {LaterKey::Of::items, "objects", "color"},   {LaterKey::Of::items, "objects", "pivot"}};

/// Adds a mistake at each key or value of version 2, with the version to write. Other mistakes are
/// ignored.
void refuse_version_two(const Json& scene, Mistakes& mistakes);

}  // namespace minkray
