// SPDX-License-Identifier: MIT
// Two bodies, shapes or meshes, whose poses are known to within a loss: their distance, and the gap
// at a plane between them.
#pragma once

#include "renderer/clearance/bodies.h"

namespace minkray {

/// `between` goes from a's middle to b's, from which points are seen; `linear` turns from each
/// body's frame to its axes. Meshes that overlap have the status overlapping, and 0 as distance.
SignedDistance distance_between(const ClearanceBody& a, const Mat3<double>& linear_a,
                                const ClearanceBody& b, const Mat3<double>& linear_b,
                                const Between& between, const SignedDistanceOptions& options);

/// No point of b is nearer to one of a than this along the unit vector n.
double gap_between(const ClearanceBody& a, const Mat3<double>& linear_a, const ClearanceBody& b,
                   const Mat3<double>& linear_b, const Between& between, const Vec3<double>& n);

}  // namespace minkray
