// SPDX-License-Identifier: MIT
#include "renderer/import/mesh_looks.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <string_view>

#include "core/files/regular_file.h"
#include "renderer/base/of_file.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

constexpr std::size_t most_obj_bytes = std::size_t{512} << 20;
constexpr std::size_t most_mtl_bytes = std::size_t{16} << 20;

/// Without a comment and the blanks around it.
std::string_view next_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  line = line.substr(0, line.find('#'));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

/// Cuts the first word off a line, with the blanks behind it.
std::string_view next_word(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return word;
}

std::optional<double> next_number(std::string_view& line) {
  const std::string_view word = next_word(line);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || !(number >= 0 && number <= 1))
    return std::nullopt;
  return number;
}

/// The diffuse colours (Kd) of a material library, with the opacity (d) of each.
void read_mtl(std::string_view text, std::map<std::string, Rgba>& materials) {
  std::string name;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const std::string_view key = next_word(line);
    if (key == "newmtl") {
      name = line;
    } else if (key == "Kd") {
      const auto r = next_number(line), g = next_number(line), b = next_number(line);
      if (!r || !g || !b) continue;
      Rgba& rgba = materials.try_emplace(name, Rgba{0, 0, 0, 1}).first->second;
      rgba = {*r, *g, *b, rgba[3]};
    } else if (key == "d") {
      if (const auto d = next_number(line)) {
        const auto known = materials.find(name);
        if (known != materials.end()) known->second[3] = *d;
      }
    }
  }
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

MeshLooks obj_looks(const std::filesystem::path& file) {
  const std::string bytes = read_regular_file(file, most_obj_bytes);
  std::string_view text = bytes;
  MeshLooks looks;
  std::map<std::string, Rgba> materials;
  std::map<std::pair<std::string, std::string>, std::size_t> part_of;
  std::string object, group, material;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const std::string_view key = next_word(line);
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
      if (const auto known = materials.find(material); known != materials.end())
        ++looks.parts[part->second].colours[known->second];
    } else if (key == "mtllib") {
      const std::filesystem::path library = file.parent_path() / std::string(line);
      try {
        read_mtl(read_regular_file(library, most_mtl_bytes), materials);
        looks.files.push_back(library);
      } catch (const std::exception& error) {
        looks.notes.push_back("its materials in " + printable(std::string(line), 100) + ": " +
                              what_of(error));
      }
    }
  }
  return looks;
}

}  // namespace minkray
