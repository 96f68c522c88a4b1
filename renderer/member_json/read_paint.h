// SPDX-License-Identifier: MIT
// Colours from JSON: three numbers, or a texture.
#pragma once

#include <optional>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/textures.h"

namespace minkray {

/// Nothing, and mistakes, if it cannot be used.
std::optional<Paint> read_paint(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                Range range, MeshFiles& files);

/// Inverse of read_paint.
Json write_paint(const Paint& paint);

}  // namespace minkray
