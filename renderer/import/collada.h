// SPDX-License-Identifier: MIT
// COLLADA 1.4 and 1.5 (.dae): the vertices of the meshes that the scene's nodes show, under the
// nodes' transforms, in metres by the file's unit. The up axis that a file names turns nothing:
// RViz, Gazebo and MoveIt show robots' meshes so, and their files rely on it. Skins are taken as
// their mesh at rest.
#pragma once

#include "renderer/import/mesh_library.h"

namespace minkray {

/// Each mesh that a node shows is a group. Throws std::runtime_error without
/// the file's name.
MeshContent read_collada(const std::filesystem::path& file, MeshSplit split, bool with_triangles);

}  // namespace minkray
