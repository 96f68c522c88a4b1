// SPDX-License-Identifier: MIT
// Error bounds of the derivative of a time of impact with respect to the bodies' motion. The
// derivative is -(d gap/d twist)/(d gap/dt). Its error is computed from the error of the distance's
// derivative at t_lo (Impact), and from the bodies' motion until they certainly touch, at t_hi.
#pragma once

#include "core/pair_derivative/pair_derivative.h"

namespace minkray {

/// Bounds the error of `derivative`, which was computed from `found`, the first contact of the two
/// motions. The error is zero if the bodies overlap at time 0, and NaN without contact. The error
/// is infinite on ridges; for two cores without a radius, since the normal at the contact is
/// unknown; for turns, if the nearest points may slide along an edge or a face; and if no overlap
/// was proven after the contact.
PairDerivativeError error_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found, const PairDerivative& derivative);

/// Returns the error that the status alone determines: zero if inside, NaN without contact,
/// infinite for a contact.
PairDerivativeError error_of(const Impact& found);

}  // namespace minkray
