// SPDX-License-Identifier: MIT
// glTF 2.0 (.gltf, .glb): nodes as links, their meshes as hulls, colliders of
// KHR_physics_rigid_bodies with the shapes of KHR_implicit_shapes. y is up in the file and z here,
// so everything is rotated.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// The model of a file's bytes, which is not to be used if anything was added to the mistakes.
Model read_gltf(std::string bytes, const std::filesystem::path& file, const ImportOptions& options,
                Mistakes& mistakes);

/// All meshes that the file's scene shows, as one mesh; each of them is a part, if groups are
/// requested. Throws std::runtime_error without the file's name.
MeshContent read_gltf_content(const std::filesystem::path& file, MeshSplit split,
                              MeshDetail detail);

/// Larger files are refused.
inline constexpr std::size_t most_gltf_bytes = std::size_t{1} << 30;

}  // namespace minkray
