// SPDX-License-Identifier: MIT
// Reads a block of particles of a scene file (docs/scene-format.md).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "renderer/base/hash.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Input of the reader of a block.
struct ParticleSource {
  const Scene& scene;                   ///< as far as it is read
  const std::filesystem::path& folder;  ///< files are named relative to it
  MeshFiles& meshes;
  Hash& hash;                                 ///< files' contents go into it
  std::vector<std::filesystem::path>& files;  ///< gets the files that are read
  std::size_t most_rows;                      ///< no more particles than these
  /// The index of the material of that name; a mistake, and any index, if there is none.
  std::function<std::uint32_t(const Json&, const JsonPath&)> material_named;
};

/// Nothing, and mistakes, if anything in it is wrong.
std::optional<ParticleSet> read_particles(const Json& json, const JsonPath& path,
                                          Mistakes& mistakes, const ParticleSource& source);

}  // namespace minkray
