// SPDX-License-Identifier: MIT
// First contact of two cores where one moves without turning and the distance has a closed form.
// The signed distance is a convex function of the place, and so of the time: Newton's method from
// the left never goes too far. Each of its steps is proven by the plane between the two.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// Points and segments; points and boxes, cylinders, cones, disks. A's kind is not after B's.
bool has_swept_closed(const CorePair& pair);

/// Like SweptPortal (swept_portal.h). Leaves some cases to other methods.
SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near);

}  // namespace minkray
