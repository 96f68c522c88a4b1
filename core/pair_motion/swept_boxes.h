// SPDX-License-Identifier: MIT
// First contact of a box that moves without turning and a box at rest. C = B - A (core_pair.h) is
// the intersection of 15 slabs, which lie between parallel planes (S. Gottschalk et al., "OBBTree",
// 1996); a ray is in C while it is in all slabs.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// Returns the time of impact. For the parameters see SweptPortal (swept_portal.h). Returns `open`
/// if the boxes touch at the start, only graze each other, or touch with edges or faces in one
/// plane.
SweptTime swept_boxes(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                      double near);

}  // namespace minkray
