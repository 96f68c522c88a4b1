// SPDX-License-Identifier: MIT
// Reads and writes scene files (docs/scene-format.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Versions of the format: what programs write unless they need more, and the newest one.
inline constexpr int scene_version = 1;
inline constexpr int newest_scene_version = 2;

/// Purpose that a scene is read for: without a picture it needs no camera and no lights.
enum class ScenePurpose : unsigned char { picture, rays };

/// The scene that the text describes. Nothing if there is any mistake in it; all of them are
/// added to the mistakes. Mesh files and included files are looked for in `folder`. `other_files`,
/// if any, gets the files that were read besides pictures.
std::optional<Scene> parse_scene(std::string_view text, const std::filesystem::path& folder,
                                 Mistakes& mistakes,
                                 std::vector<std::filesystem::path>* other_files = nullptr,
                                 ScenePurpose purpose = ScenePurpose::picture);

/// The scene in a file. Throws BadInput with all mistakes, one a line.
Scene load_scene(const std::filesystem::path& file,
                 std::vector<std::filesystem::path>* other_files = nullptr,
                 ScenePurpose purpose = ScenePurpose::picture);

}  // namespace minkray
