// SPDX-License-Identifier: MIT
// COLLADA 1.4 and 1.5 (.dae): the vertices of the meshes that the scene's nodes show, under the
// nodes' transforms, in metres by the file's unit, with z up. Skins are taken as their mesh at
// rest.
#pragma once

#include "renderer/import/mesh_library.h"

namespace minkray {

/// Each mesh that a node shows is a part, if parts are asked for. Throws std::runtime_error without
/// the file's name.
MeshParts read_collada(const std::filesystem::path& file, MeshSplit split);

}  // namespace minkray
