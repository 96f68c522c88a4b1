// SPDX-License-Identifier: MIT
#include "renderer/import/model/mesh_looks.h"

#include <algorithm>
#include <exception>
#include <string_view>

#include "core/files/mtl_file.h"
#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/of_file.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

constexpr std::size_t most_obj_bytes = std::size_t{512} << 20;
constexpr std::size_t most_mtl_bytes = std::size_t{16} << 20;

struct Library {
  std::map<std::string, MtlMaterial> materials;
  std::filesystem::path folder;
};

/// The material of the name in the libraries, of several the last one.
const MtlMaterial* find_material(const std::vector<Library>& libraries, const std::string& name,
                                 std::filesystem::path& folder) {
  for (std::size_t i = libraries.size(); i-- > 0;) {
    const auto found = libraries[i].materials.find(name);
    if (found == libraries[i].materials.end()) continue;
    folder = libraries[i].folder;
    return &found->second;
  }
  return nullptr;
}

std::optional<Rgba> rgba_of(const MtlMaterial& material) {
  if (!material.colour) return std::nullopt;
  const auto& [r, g, b] = *material.colour;
  return Rgba{r, g, b, material.opacity};
}

}  // namespace

std::optional<Rgba> colour_of(const PartLook& part) {
  const auto most =
      std::ranges::max_element(part.colours, {}, [](const auto& colour) { return colour.second; });
  return most == part.colours.end() ? std::nullopt : std::optional(most->first);
}

std::optional<Rgba> colour_of(const MeshLooks& looks) {
  PartLook all;
  for (const PartLook& part : looks.parts)
    for (const auto& [rgba, faces] : part.colours) all.colours[rgba] += faces;
  return colour_of(all);
}

std::size_t colour_count(const MeshLooks& looks) {
  std::map<Rgba, std::size_t> all;
  for (const PartLook& part : looks.parts) all.insert(part.colours.begin(), part.colours.end());
  return all.size();
}

MeshLooks obj_looks(const std::filesystem::path& file, const std::vector<std::string>& names,
                    std::vector<MeshMaterial>& materials) {
  const std::string bytes = read_regular_file(file, most_obj_bytes);
  std::string_view text = bytes;
  MeshLooks looks;
  std::vector<Library> libraries;
  std::filesystem::path folder;
  std::map<std::pair<std::string, std::string>, std::size_t> part_of;
  std::string object, group, material;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    line = line.substr(0, line.find('#'));
    const std::string_view key = next_word(line);
    line = without_blanks(line);
    if (key == "o") {
      object = line;
      group.clear();
    } else if (key == "g") {
      group = line;
    } else if (key == "usemtl") {
      material = line;
    } else if (key == "f") {
      const auto [part, is_new] = part_of.try_emplace({object, group}, looks.parts.size());
      if (is_new) looks.parts.push_back({{object, group}, {}});
      const MtlMaterial* known = find_material(libraries, material, folder);
      if (const auto rgba = known ? rgba_of(*known) : std::nullopt)
        ++looks.parts[part->second].colours[*rgba];
    } else if (key == "mtllib") {
      const std::filesystem::path library = file.parent_path() / std::string(line);
      try {
        Library read{{}, library.parent_path()};
        read_mtl(read_regular_file(library, most_mtl_bytes), read.materials);
        libraries.push_back(std::move(read));
        looks.files.push_back(library);
      } catch (const std::exception& error) {
        looks.notes.push_back("its materials in " + printable(std::string(line), 100) + ": " +
                              what_of(error));
      }
    }
  }
  for (const std::string& name : names) {
    MeshMaterial& made = materials.emplace_back();
    const MtlMaterial* known = find_material(libraries, name, folder);
    made.has_any = known && (known->colour || !known->picture.empty());
    if (!made.has_any) continue;
    // Many programs write any colour next to a picture, even black.
    if (known->picture.empty()) {
      made.rgba = *rgba_of(*known);
    } else {
      made.file = picture_file(folder, known->picture);
      made.without_picture = rgba_of(*known);
    }
  }
  return looks;
}

}  // namespace minkray
