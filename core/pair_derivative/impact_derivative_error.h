// SPDX-License-Identifier: MIT
// Error bounds of the derivative of a time of impact, -(d gap/d twist)/(d gap/dt). Computed from
// the error of the distance's derivative at t_lo, and from the bodies' motion until they certainly
// touch.
#pragma once

#include "core/pair_derivative/pair_derivative.h"

namespace minkray {

/// `derivative` belongs to `found`, the first contact of the two motions. The error is zero if the
/// bodies overlap at time 0, and NaN without contact. The error is infinite on ridges; for two
/// cores without a radius, since the normal at the contact is unknown; for turns, if the nearest
/// points may slide along an edge or a face; and if no overlap was proven after the contact.
PairDerivativeError error_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found, const PairDerivative& derivative);

/// Returns what the status alone determines: zero, NaN, or infinite for a contact.
PairDerivativeError error_of(const Impact& found);

}  // namespace minkray
