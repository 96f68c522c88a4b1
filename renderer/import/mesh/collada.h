// SPDX-License-Identifier: MIT
// COLLADA 1.4 and 1.5 (.dae): vertices of the meshes in the scene's nodes, with the nodes'
// transforms, in metres by the file's unit. The up axis is ignored, as in RViz, Gazebo and MoveIt,
// since robots' files rely on it. Skins are read as meshes at rest.
#pragma once

#include "renderer/import/mesh/mesh_library.h"

namespace minkray {

/// Each mesh that a node shows is a group. Throws std::runtime_error without
/// the file's name.
MeshContent read_collada(const std::filesystem::path& file, MeshSplit split, MeshDetail detail);

}  // namespace minkray
