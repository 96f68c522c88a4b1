// SPDX-License-Identifier: MIT
// Contact points of two bodies, and how their distance and their time of impact change: of the two
// parts that are nearest, or that touch first.
#pragma once

#include "core/contact/manifold.h"
#include "core/contact/pair_derivative.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Looks at no more than the two parts that are nearest, or that cross. There are no points where
/// one body is within the other without a crossing.
ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b);

/// How the distance changes: of the two parts that are nearest. Of surfaces that cross it is zero,
/// and a ridge.
PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b);
/// How the time of impact changes.
PairDerivative derivative_of(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                             const RigidMotion& motion_b, double t_max);

}  // namespace minkray
