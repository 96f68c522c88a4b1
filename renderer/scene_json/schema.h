// SPDX-License-Identifier: MIT
// The JSON Schema of scene files, made of the same descriptions that read them.
#pragma once

#include "renderer/json/json.h"

namespace minkray {

/// JSON Schema, draft 2020-12. Rules that it cannot express (a material must exist, a matrix must
/// be invertible, ...) are checked only when a file is read.
Json scene_schema();

/// The part for meshes.
Json mesh_schema();

}  // namespace minkray
