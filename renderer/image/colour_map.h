// SPDX-License-Identifier: MIT
// Colours for numbers: Stéfan van der Walt and Nathaniel Smith's "inferno" (2015, CC0), as a
// polynomial: equal steps of the value look equally large, and more is always lighter.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// The colour (linear RGB) of a value in [0, 1]: near black to light yellow.
Vec3<float> inferno(double value);

}  // namespace minkray
