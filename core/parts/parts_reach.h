// SPDX-License-Identifier: MIT
// How far a body reaches along a direction: by it two bodies are kept apart by a plane, whatever
// their parts are, and a body is above a half-space.
#pragma once

#include "core/contact/half_space_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// No point of the body is further along the unit vector `n` than this, seen from its middle.
/// `linear` turns from the body's frame to that of n.
double reach_along(const PartsBody& body, const Mat3<double>& linear, const Vec3<double>& n);

/// How far a body is above the plane of a half-space; less than 0 if a part of it is below.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const PartsBody& body,
                                      const Affine<double>& pose);

}  // namespace minkray
