// SPDX-License-Identifier: MIT
// Normals of surfaces with relief, from differences of the height along the surface (Blinn,
// "Simulation of Wrinkled Surfaces", 1978) or from normal maps. Heights are functions of the
// position, so no UV coordinates are needed.
#pragma once

#include "renderer/scene/relief.h"
#include "renderer/surfaces/texture.h"

namespace minkray {

/// With pictures of heights and normals that hold numbers, not light: what was read from sRGB codes
/// is the codes again.
Relief in_numbers(const Relief& relief);

/// Outward, of unit length, in the object's frame as the place is. The relief must be in numbers.
Vec3<double> relief_normal(const Relief& relief, const TexturePoint& at);

}  // namespace minkray
