// SPDX-License-Identifier: MIT
// Focus distance of a scene's camera, which may be given by an object's name.
#pragma once

#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Sets the camera's `focus`, once the objects are read. `path` is the camera's in the file.
void find_focus(Scene& scene, const JsonPath& path, Mistakes& mistakes);

}  // namespace minkray
