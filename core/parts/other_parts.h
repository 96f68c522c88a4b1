// SPDX-License-Identifier: MIT
// Finds out whether the derivative that two parts determine is that of their bodies: other parts
// that are as near, or touch at the same time, may have another one, as both sides of a valley do.
#pragma once

#include "core/pair_derivative/pair_derivative.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// True if other parts are as near as the nearest ones, which are `distance` apart, and the
/// distance of those has another derivative.
bool differ_in_derivative(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                          const Affine<double>& pose_b, const PartPair& nearest, double distance,
                          const PairDerivative& derivative);

/// True if other parts touch at the time of the first contact, `found`, and the time of their
/// contact has another derivative.
bool differ_in_derivative(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                          const RigidMotion& motion_b, const PartPair& first, const Impact& found,
                          const PairDerivative& derivative);

}  // namespace minkray
