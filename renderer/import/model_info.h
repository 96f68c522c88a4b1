// SPDX-License-Identifier: MIT
// Contents of a robot's file, and what is not in the scene.
#pragma once

#include <string>

#include "renderer/import/model/model.h"
#include "renderer/json/json.h"

namespace minkray {

std::string model_as_text(const Model& model);

/// A line a mesh.
std::string meshes_as_text(const std::vector<ModelMesh>& meshes);
Json meshes_as_json(const std::vector<ModelMesh>& meshes);

/// An object of counts, meshes with how far from convex they are, and what was passed over and why.
Json model_as_json(const Model& model);

}  // namespace minkray
