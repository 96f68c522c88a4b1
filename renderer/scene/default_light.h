// SPDX-License-Identifier: MIT
// Light and background where a file has none.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

inline const Background default_background = {{0.72, 0.8, 0.9}, {0.93, 0.93, 0.93}};

/// Adds a sun and a sky, and sets the background; a lamp at the camera where a plane hides the sun
/// from everything, as it does within walls, which have no end.
void light_everything(Scene& scene);

}  // namespace minkray
