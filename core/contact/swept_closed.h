// SPDX-License-Identifier: MIT
// When two cores first touch of which one moves without turning and whose distance has a closed
// form. The signed distance is a convex function of the place, and so of the time: Newton's method
// from the left never goes too far. Each of its steps is what the plane between the two proves.
#pragma once

#include "core/contact/swept_query.h"

namespace minkray {

/// Points and segments; points and boxes, cylinders, cones, disks. A's kind is not after B's.
bool has_swept_closed(const CorePair& pair);

/// As SweptPortal has it (swept_portal.h). What it leaves open others may tell.
SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near);

}  // namespace minkray
