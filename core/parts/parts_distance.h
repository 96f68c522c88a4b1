// SPDX-License-Identifier: MIT
// Signed distance of two bodies that are not both shapes: the least distance over all pairs of
// their parts (PartsBody). Parts are convex, so each pair has proven bounds. The smallest of the
// pairs' lower bounds and the smallest of their upper bounds hold for the bodies.
#pragma once

#include "core/pair_distance/signed_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Returns the distance of the surfaces. If the surfaces cross, or one body lies within the other,
/// the status is overlapping, and value and both bounds are 0, since no depth is computed. Only
/// closed meshes and convex parts can contain bodies. If surfaces cross, the points lie on two
/// crossing parts, and the normal is that of a crossed face. If one body is inside the other and no
/// surfaces cross, both points are the same point of the inner body. The poses must be rigid. The
/// search begins with the pair of parts `first`. If the bodies have moved little, the pair of the
/// last query saves much of the search; any other pair only costs time. Writes the nearest or
/// crossing parts to `parts`, if not null.
SignedDistance signed_distance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                               const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {}, PartPair* parts = nullptr,
                               PartPair first = {});

/// Tests one point of each body against the other body's mesh. Returns a point that is inside;
/// there always is such a point if a mesh encloses the other body without crossing it.
std::optional<Vec3<double>> point_within(const PartsBody& a, const Affine<double>& pose_a,
                                         const PartsBody& b, const Affine<double>& pose_b);

}  // namespace minkray
