// SPDX-License-Identifier: MIT
// Mesh files of a scene file, and how far from convex each is.
#pragma once

#include <filesystem>
#include <vector>

#include "renderer/import/model/model.h"

namespace minkray {

/// Each file once for each way that it is split into parts. The scene file must be one that can be
/// loaded: what is wrong in it is passed over here.
std::vector<ModelMesh> meshes_of_scene(const std::filesystem::path& scene_file);

}  // namespace minkray
