// SPDX-License-Identifier: MIT
// How much of a lidar's light comes back, as a scene's materials say it.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace minkray {

/// Reflectances by instance: the mean of red, green and blue of its material's colour (of a texture
/// about the mean of its colours); 0 of glass, which sends nothing back by Lambert's law, and of
/// what shines.
std::vector<float> reflectances_of(const Scene& scene);

}  // namespace minkray
