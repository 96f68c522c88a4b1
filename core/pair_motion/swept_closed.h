// SPDX-License-Identifier: MIT
// First contact of a core that moves without turning and a core at rest, if the distance has a
// closed form. The signed distance is a convex function of the position, and so of the time.
// Newton's method from the left therefore never overshoots. A separating plane proves each step.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// True for points and segments, and for points and boxes, cylinders, cones or disks. A's kind must
/// not be after B's.
bool has_swept_closed(const CorePair& pair);

/// Takes the arguments of SweptPortal (swept_portal.h). Returns `open` in some cases.
SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near);

}  // namespace minkray
