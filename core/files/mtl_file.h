// SPDX-License-Identifier: MIT
// Wavefront material libraries (.mtl): diffuse colours and textures.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace minkray {

struct MtlMaterial {
  std::optional<std::array<double, 3>> colour = {};  ///< Kd, sRGB from 0 to 1
  double opacity = 1;                                ///< d
  std::string picture = {};  ///< map_Kd: file name relative to the library's folder; or empty
};

/// Adds the materials of a library by their names. Ignores invalid lines.
void read_mtl(std::string_view text, std::map<std::string, MtlMaterial>& materials);

/// Returns the path of a picture that a mesh file in `folder` names. Absolute names may be from
/// another machine; for these, the path is `folder` and the last part of the name.
std::filesystem::path picture_file(const std::filesystem::path& folder, std::string name);

}  // namespace minkray
