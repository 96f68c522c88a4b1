// SPDX-License-Identifier: MIT
// First contact of two moving bodies that are not both shapes: the earliest contact of a part of
// one body and a part of the other.
#pragma once

#include "core/pair_motion/impact.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Returns the first contact at times from 0 to t_max. The status is `inside` if the bodies overlap
/// at time 0. Writes the two parts of the result to `parts`, if not null.
Impact first_impact(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options = {},
                    PartPair* parts = nullptr);

}  // namespace minkray
