// SPDX-License-Identifier: MIT
// A scene as a scene file: what parse_scene makes the same scene of, bit for bit. Hulls are written
// with their points, so that the file stands alone.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace minkray {

/// Scenes with particles are not written: throws BadInput.
std::string scene_text(const Scene& scene);

}  // namespace minkray
