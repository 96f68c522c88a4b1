// SPDX-License-Identifier: MIT
#include "core/files/mtl_file.h"

#include <algorithm>

#include "core/files/text.h"

namespace minkray {
namespace {

std::optional<double> next_part(std::string_view& line) {
  double number = 0;
  if (!read_number(bare_number(next_word(line)), number) || !(number >= 0 && number <= 1))
    return std::nullopt;
  return number;
}

/// Number of values that follow each option of a map: "-bm 2 bricks.png" names bricks.png.
int values_of_option(std::string_view option) {
  if (option == "-o" || option == "-s" || option == "-t") return 3;
  if (option == "-mm") return 2;
  return 1;
}

/// Returns the file's name, which may contain blanks, after a map's options.
std::string picture_of(std::string_view line) {
  for (;;) {
    std::string_view rest = line;
    const std::string_view option = next_word(rest);
    if (!option.starts_with('-') || option.size() < 2) return std::string(without_blanks(line));
    int left = values_of_option(option);
    for (double number = 0; left > 0; --left) {
      std::string_view behind = rest;
      const std::string_view value = next_word(behind);
      // Offsets and scales may have fewer than three numbers.
      if (left < values_of_option(option) && !read_number(bare_number(value), number)) break;
      rest = behind;
    }
    line = rest;
  }
}

}  // namespace

void read_mtl(std::string_view text, std::map<std::string, MtlMaterial>& materials) {
  MtlMaterial* material = nullptr;
  text = without_byte_order_mark(text);
  while (!text.empty()) {
    std::string_view line = next_line(text);
    line = without_blanks(line.substr(0, line.find('#')));
    const std::string_view key = next_word(line);
    if (key == "newmtl") material = &materials[std::string(without_blanks(line))];
    if (!material) continue;
    if (key == "Kd") {
      const auto r = next_part(line), g = next_part(line), b = next_part(line);
      if (r && g && b) material->colour = {*r, *g, *b};
    } else if (key == "d") {
      if (const auto opacity = next_part(line)) material->opacity = *opacity;
    } else if (key == "map_Kd") {
      material->picture = picture_of(line);
    }
  }
}

std::filesystem::path picture_file(const std::filesystem::path& folder, std::string name) {
  std::ranges::replace(name, '\\', '/');
  const std::filesystem::path file = folder / name;
  std::error_code error;
  const std::filesystem::path last = folder / std::filesystem::path(name).filename();
  if (!std::filesystem::exists(file, error) && std::filesystem::exists(last, error)) return last;
  return file.lexically_normal();
}

}  // namespace minkray
