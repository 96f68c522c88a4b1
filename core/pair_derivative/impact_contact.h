// SPDX-License-Identifier: MIT
// Makes the normal and the points of a first contact as accurate as derivatives need. Their error
// is otherwise about the square root of the distance up to which bodies count as touching.
#pragma once

#include "core/pair_motion/impact.h"

namespace minkray {

/// Improves normal and points of `found`, a hit; its times stay. Leaves them if no better ones are
/// found.
void settle(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
            const RigidMotion& motion_b, Impact& found);

}  // namespace minkray
