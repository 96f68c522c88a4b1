// SPDX-License-Identifier: MIT
// The normal of a surface with a relief: after Blinn, "Simulation of Wrinkled Surfaces" (1978), by
// differences of the height along the surface, and by pictures of normals. No parametrisation is
// needed: heights are functions of the place, and of mappings it is known where they have right.
#pragma once

#include "renderer/light/texture.h"
#include "renderer/scene/relief.h"

namespace minkray {

/// With pictures of heights and normals that hold numbers, not light: what was read from sRGB codes
/// is the codes again.
Relief in_numbers(const Relief& relief);

/// Outward, of unit length, in the object's frame as the place is. The relief must be in numbers.
Vec3<double> relief_normal(const Relief& relief, const TexturePoint& at);

}  // namespace minkray
