// SPDX-License-Identifier: MIT
// When two boxes first touch of which one moves without turning: C is what 15 pairs of parallel
// planes have between them (S. Gottschalk et al., "OBBTree", 1996), and the ray is in C while it is
// between all of them.
#pragma once

#include "core/contact/swept_query.h"

namespace minkray {

/// As SweptPortal has it (swept_portal.h). What it leaves open others may tell: contacts at the
/// start, grazing ones, and those of edges or faces in one plane.
SweptTime swept_boxes(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                      double near);

}  // namespace minkray
