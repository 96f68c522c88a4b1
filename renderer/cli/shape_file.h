// SPDX-License-Identifier: MIT
// A file that holds one shape, as scenes have them.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/cli/command_files.h"
#include "renderer/json/parse.h"
#include "renderer/scene/shape_json.h"

namespace minkray {

/// Throws BadInput with all that is wrong with it. `files`, if any, get those that it names.
inline Shape<double> shape_in(const std::string& file, CommandFiles* files = nullptr) {
  Mistakes mistakes(file);
  MeshFiles meshes(std::filesystem::path(file).parent_path());
  std::optional<Shape<double>> shape;
  if (const auto text = read_text_file(file, mistakes))
    if (const auto json = parse_json(*text, mistakes))
      shape = read_shape(*json, JsonPath(), mistakes, meshes);
  throw_if_any(mistakes);
  if (files) files->read(meshes.meshes());
  return *shape;
}

}  // namespace minkray
