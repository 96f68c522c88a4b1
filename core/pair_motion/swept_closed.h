// SPDX-License-Identifier: MIT
// First contact of a core that moves without turning and a core at rest, if the distance has a
// closed form. The signed distance is a convex function of the position, and thus of the time.
// Newton's method from the left therefore never overshoots. A separating plane proves each step.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// True if swept_closed() supports the pair: points and segments, or a point and a box, cylinder,
/// cone or disk. A's kind must not be after B's in CoreKind.
bool has_swept_closed(const CorePair& pair);

/// Returns the time of impact. For the parameters see SweptPortal (swept_portal.h). Returns `open`
/// if the search cannot decide.
SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near);

}  // namespace minkray
