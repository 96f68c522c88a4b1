// SPDX-License-Identifier: MIT
// Finds the first body at rest that a moving body touches, and the time. Bodies are tried in the
// order in which the moving body's box reaches their boxes.
#pragma once

#include "core/pair_motion/earliest_impact.h"
#include "core/world/near_pairs.h"

namespace minkray {

/// Returns the first impact of `moving` (A of the result) with a body whose category shares a bit
/// with `mask`. `known` is the earliest impact already found with other bodies.
EarliestImpact first_impact(const PartsBody& moving, const RigidMotion& motion,
                            const ContactWorld& world, double t_max, std::uint32_t mask,
                            const EarliestImpact& known);

}  // namespace minkray
