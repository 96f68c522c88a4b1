// SPDX-License-Identifier: MIT
// Distance of two bodies, one of them a mesh or both: the least of all pairs of their parts.
// Parts are convex, so bounds of parts are bounds of the whole.
#pragma once

#include "core/pair_distance/signed_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Distance of the surfaces. If they cross, or one body lies within the other, the status is
/// overlapping, and value and both bounds are 0: there is no depth. Only closed meshes can contain
/// bodies. The points of an overlap are of the two parts that cross, or one point of the body
/// within; the normal is that of a face that is crossed. The poses must be rigid.
SignedDistance signed_distance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                               const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {},
                               PartPair* parts = nullptr);

/// Returns a point of one body that is within the other. Always finds one if a mesh encloses a body
/// without crossing it.
std::optional<Vec3<double>> point_within(const PartsBody& a, const Affine<double>& pose_a,
                                         const PartsBody& b, const Affine<double>& pose_b);

}  // namespace minkray
