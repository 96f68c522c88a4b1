// SPDX-License-Identifier: MIT
// The materials of a scene by their names, and those that objects make of colours.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Colour of objects with neither a material nor a colour.
inline const Colour default_colour = Colour::Constant(0.5);

class MaterialNames {
 public:
  explicit MaterialNames(Scene& scene) : scene_(scene) {}

  /// Adds a material at the end of the scene's; a mistake if the name is taken.
  bool add(Material material, const JsonPath& path, Mistakes& mistakes);

  /// The index of the material that is named; a mistake, and 0, if there is none.
  std::uint32_t named(const Json& name, const JsonPath& path, Mistakes& mistakes) const;

  /// Returns the matt material of a colour or texture, the same one for the same JSON; 0 and a
  /// mistake if the JSON is invalid. `file` distinguishes textures of different files.
  std::uint32_t of_colour(const Json& colour, const JsonPath& path, Mistakes& mistakes,
                          MeshFiles& files, const std::string& file);

  /// Adds a matt material of a mesh file's, the same for the same name and `file`.
  std::uint32_t of_file(const std::string& name, const void* file, const Paint& paint);

  /// Material of objects with neither a material nor a colour.
  std::uint32_t default_one();

 private:
  std::uint32_t add_made(const std::string& name, const Paint& paint);

  Scene& scene_;
  std::map<std::string, std::uint32_t> index_;
  std::map<std::string, std::uint32_t> of_colours_;
  std::map<std::pair<const void*, std::string>, std::uint32_t> of_files_;
};

}  // namespace minkray
