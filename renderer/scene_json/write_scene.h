// SPDX-License-Identifier: MIT
// Writes a scene as a scene file, which parse_scene reads back bit for bit. Hulls are written with
// their points, so the file needs no mesh files.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace minkray {

/// Scenes with particles are not written: throws BadInput.
std::string scene_text(const Scene& scene);

}  // namespace minkray
