// SPDX-License-Identifier: MIT
// Names of a mesh file's parts, and the colours of their materials.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/named.h"

namespace minkray {

/// As robots' files have colours: red, green, blue (sRGB) and opacity, from 0 to 1.
using Rgba = std::array<double, 4>;

/// Few lines can show a part again and again: of more, no looks are kept.
inline constexpr std::size_t most_part_looks = 10'000;

struct PartLook {
  std::vector<std::string> names;       ///< each of them names the part
  std::map<Rgba, std::size_t> colours;  ///< faces of each
};

/// A material of a mesh file: a colour, or a picture times the colour.
struct MeshMaterial {
  Rgba rgba = {1, 1, 1, 1};
  std::optional<Rgba> without_picture = {};       ///< the colour if the picture cannot be read
  std::filesystem::path file = {};                ///< of the picture; empty: none
  std::shared_ptr<const std::string> bytes = {};  ///< of one within the mesh's file
  PictureFile picture = {};                       ///< as MeshLibrary has read it
  bool has_any = true;                            ///< the file describes it

  bool has_picture() const { return !file.empty() || bytes; }
};

struct MeshLooks {
  std::vector<PartLook> parts;  ///< in the order of the parts, if these are the file's groups
  std::vector<std::filesystem::path> files = {};  ///< that were read for them
  std::vector<std::string> notes = {};            ///< contents that could not be used
};

/// The colour of most faces of a part, or of all parts together; nothing if none has one.
std::optional<Rgba> colour_of(const PartLook& part);
std::optional<Rgba> colour_of(const MeshLooks& looks);

/// Number of colours in all parts.
std::size_t colour_count(const MeshLooks& looks);

/// Reads an OBJ file's groups and the materials (.mtl) that it names. `materials`, if any, get
/// those of the names.
MeshLooks obj_looks(const std::filesystem::path& file, const std::vector<std::string>& names,
                    std::vector<MeshMaterial>& materials);

}  // namespace minkray
