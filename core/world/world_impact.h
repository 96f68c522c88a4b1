// SPDX-License-Identifier: MIT
// Finds which of many bodies at rest a moving one touches first, and when: bodies are tried in the
// order in which the moving one's box meets theirs.
#pragma once

#include "core/pair_motion/earliest_impact.h"
#include "core/world/near_pairs.h"

namespace minkray {

/// A is the moving body. All bodies with a bit of `mask` in their category are tested; `known` is
/// the earliest impact already found with others.
EarliestImpact first_impact(const PartsBody& moving, const RigidMotion& motion,
                            const ContactWorld& world, double t_max, std::uint32_t mask,
                            const EarliestImpact& known);

}  // namespace minkray
