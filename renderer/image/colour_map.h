// SPDX-License-Identifier: MIT
// Colour map for numbers: Stéfan van der Walt and Nathaniel Smith's "inferno" (2015, CC0) as a
// polynomial. Equal steps look equally large, and greater values are lighter.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// The colour (linear RGB) of a value in [0, 1]: near black to light yellow.
Vec3<float> inferno(double value);

}  // namespace minkray
