// SPDX-License-Identifier: MIT
// A file that contains one shape, in the format of scenes.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/cli/command_files.h"
#include "renderer/json/parse.h"
#include "renderer/member_json/shape_json.h"

namespace minkray {

/// Throws BadInput with all mistakes of the file. Adds the files that it names to `files` if not
/// null.
inline Shape shape_in(const std::string& file, CommandFiles* files = nullptr) {
  Mistakes mistakes(file);
  MeshFiles meshes(std::filesystem::path(file).parent_path());
  std::optional<Shape> shape;
  if (const auto text = read_text_file(file, mistakes))
    if (const auto json = parse_json(*text, mistakes))
      shape = read_shape(*json, JsonPath(), mistakes, meshes);
  throw_if_any(mistakes);
  if (files) files->read(meshes.meshes());
  return *shape;
}

}  // namespace minkray
