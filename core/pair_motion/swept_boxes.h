// SPDX-License-Identifier: MIT
// First contact of two boxes where one moves without turning: C is the intersection of 15 pairs of
// parallel planes (S. Gottschalk et al., "OBBTree", 1996), and the ray is in C while it is between
// all of them.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// Like SweptPortal (swept_portal.h). Leaves some cases to other methods: contacts at the start,
/// grazing ones, and those of edges or faces in one plane.
SweptTime swept_boxes(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                      double near);

}  // namespace minkray
