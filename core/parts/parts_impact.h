// SPDX-License-Identifier: MIT
// When two moving bodies first touch of which at least one is a mesh: when the first two of their
// parts do.
#pragma once

#include "core/contact/impact.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// The first contact at times from 0 to t_max: inside if the bodies overlap at time 0.
Impact first_impact(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options = {},
                    PartPair* parts = nullptr);

}  // namespace minkray
