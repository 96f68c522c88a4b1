// SPDX-License-Identifier: MIT
// Wavefront material libraries (.mtl): diffuse colours and their pictures.
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
  std::string picture = {};  ///< map_Kd: a file's name, relative to the library's folder; or empty
};

/// Adds the materials of a library by their names. Lines that are wrong are ignored.
void read_mtl(std::string_view text, std::map<std::string, MtlMaterial>& materials);

/// The file of a picture that a mesh file names: as named, or by its last name in the folder, for
/// absolute names of other machines.
std::filesystem::path picture_file(const std::filesystem::path& folder, std::string name);

}  // namespace minkray
