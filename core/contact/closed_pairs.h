// SPDX-License-Identifier: MIT
// Pairs of cores whose signed distance has a closed form: points, segments and boxes.
#pragma once

#include "core/contact/core_pair.h"

namespace minkray {

/// Points and segments against each other, and points against boxes: both bounds are the distance,
/// negative inside a box. `axis` is the direction of the least translation that separates. Returns
/// false for other pairs.
bool closed_distance(const CorePair& pair, CoreDistance& found);

/// Two boxes that overlap: the least overlap of 15 axes is the penetration depth
/// (S. Gottschalk et al., "OBBTree", 1996). Boxes that do not overlap get the largest gap of the
/// axes, which is a lower bound of their distance. a and c are not found.
CoreDistance box_overlap(const CorePair& pair);

}  // namespace minkray
