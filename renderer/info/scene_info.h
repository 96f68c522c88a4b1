// SPDX-License-Identifier: MIT
// The texts that `minkray info` prints. Each ends with a newline.
#pragma once

#include <string>

#include "renderer/json/json.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Contents of a scene: counts of shapes, bounds, memory, lights, camera.
std::string info_as_text(const Scene& scene);
/// `model`, `meshes` and `other_models`, if they are not empty, are written as well: what the scene
/// was made of.
std::string info_as_json(const Scene& scene, Json model = nullptr, Json meshes = nullptr,
                         Json other_models = nullptr);

/// All kinds of shapes with their parameters, units, constraints and docs.
std::string shapes_as_text();
std::string shapes_as_json();
std::string shapes_as_markdown();

/// The JSON Schema of scene files.
std::string schema_text();

}  // namespace minkray
