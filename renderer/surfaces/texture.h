// SPDX-License-Identifier: MIT
// Colour of a paint at a point.
#pragma once

#include "renderer/surfaces/texture_place.h"

namespace minkray {

/// The mean over the place's footprint, by boxes along its longer side. Pictures are interpolated
/// between pixels, and repeat.
Colour paint_at(const Paint& paint, const TexturePoint& at);

}  // namespace minkray
