// SPDX-License-Identifier: MIT
// Bounds of the errors of a time of impact's derivative -(d gap/d twist)/(d gap/dt): from those of
// the distance's derivative at t_lo, and how far the bodies get until they touch for sure.
#pragma once

#include "core/pair_derivative/pair_derivative.h"

namespace minkray {

/// `derivative` is that of `found`, the first contact of the two motions. Zero where they begin
/// inside each other, NaN where there is no contact. Infinite on ridges, for two cores without a
/// radius, whose direction is not known where they touch, for turns about what may slide, and where
/// no overlap was proven after the contact.
PairDerivativeError error_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found, const PairDerivative& derivative);

/// Returns what the status alone determines: zero, NaN, or infinite for a contact.
PairDerivativeError error_of(const Impact& found);

}  // namespace minkray
