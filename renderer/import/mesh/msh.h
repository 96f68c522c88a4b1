// SPDX-License-Identifier: MIT
// MuJoCo's own binary meshes (.msh): four counts, then vertices, normals, texture coordinates and
// faces, in little-endian numbers of 32 bits.
#pragma once

#include "renderer/import/mesh/mesh_library.h"

namespace minkray {

/// Throws std::runtime_error without the file's name.
MeshParts read_msh(const std::filesystem::path& file, MeshSplit split, MeshDetail detail);

}  // namespace minkray
