// SPDX-License-Identifier: MIT
// Share of a lidar's light that returns, from a scene's materials.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace minkray {

/// Reflectances by instance: the mean of red, green and blue of the material's colour (for a
/// texture about the mean of its colours); 0 for glass, which returns nothing by Lambert's law, and
/// for emissive objects.
std::vector<float> reflectances_of(const Scene& scene);

}  // namespace minkray
