// SPDX-License-Identifier: MIT
// How far apart two bodies are of which at least one is a mesh: the least of all pairs of their
// parts, each of which is convex, so that the bounds of parts are bounds of the whole.
#pragma once

#include "core/contact/signed_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// The distance of surfaces. Where they cross, or one body lies within the other (which of meshes
/// only closed ones allow), the status is overlapping, value and both bounds are 0, and the points
/// are of the two parts that cross, or one point of what is within: there is no depth, and the
/// normal is that of a face that is crossed. The poses are rigid.
SignedDistance signed_distance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                               const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {},
                               PartPair* parts = nullptr);

/// A point of one body that is within the other one, if a mesh encloses what it does not cross.
std::optional<Vec3<double>> point_within(const PartsBody& a, const Affine<double>& pose_a,
                                         const PartsBody& b, const Affine<double>& pose_b);

}  // namespace minkray
