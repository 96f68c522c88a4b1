// SPDX-License-Identifier: MIT
// The JSON Schema of scene files, made of the same descriptions that read them.
#pragma once

#include "renderer/json/json.h"

namespace minkray {

/// JSON Schema, draft 2020-12. What it cannot say (a material's name must exist, a matrix must be
/// invertible, ...) is checked on reading only.
Json scene_schema();

/// The part for meshes.
Json mesh_schema();

}  // namespace minkray
