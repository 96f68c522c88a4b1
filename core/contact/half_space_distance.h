// SPDX-License-Identifier: MIT
// How far a shape is from a half-space, which has no end and so no support mapping: how far its
// lowest point is above the plane.
#pragma once

#include "core/contact/signed_distance.h"

namespace minkray {

/// A is the half-space of all points x with normal . x <= offset, the normal of unit length, B the
/// shape at a rigid pose. Less than 0 if a part of B is below the plane, which that far moved along
/// the normal is out of it. Of lengths that are no numbers nothing is known (is_unknown()).
SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose);

}  // namespace minkray
