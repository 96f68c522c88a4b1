// SPDX-License-Identifier: MIT
// Impact of two bodies that do not turn: a ray cast at their difference. Bodies that are far apart
// first move near each other, exactly.
#pragma once

#include "core/pair_motion/impact.h"
#include "core/pair_motion/swept_time.h"

namespace minkray {

/// Returns `open` for contacts at the start and for grazing contacts. For a miss, sets only the
/// normal. `memory` may be null.
SweptStatus straight_impact(const ContactShape& a, const RigidMotion& motion_a,
                            const ContactShape& b, const RigidMotion& motion_b, double t_max,
                            const ImpactOptions& options, PairMemory* memory, Impact& result);

}  // namespace minkray
