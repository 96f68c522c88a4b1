// SPDX-License-Identifier: MIT
// Extent of a body along a direction. Used to separate two bodies by a plane without testing their
// parts, and to measure a body's height above a half-space.
#pragma once

#include "core/pair_distance/half_space_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Upper bound of n . p over the body's points p, relative to its middle. `n` is a unit vector;
/// `linear` rotates from the body's frame to the frame of n.
double reach_along(const PartsBody& body, const Mat3<double>& linear, const Vec3<double>& n);

/// Distance of a body from the plane of a half-space; below 0 if a part of the body is below the
/// plane.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const PartsBody& body,
                                      const Affine<double>& pose);

}  // namespace minkray
