// SPDX-License-Identifier: MIT
// Contact points of two bodies, and derivatives of their distance and time of impact. Derivatives
// are those of the two parts that are nearest or touch first.
#pragma once

#include "core/pair_derivative/pair_derivative.h"
#include "core/pair_distance/manifold.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Returns contact points of the pairs of parts that are about as near as the nearest and have
/// about the same normal, at most four points in all, spread out. points[0] is as near as the
/// nearest. Returns no points if one body is inside the other and their surfaces do not cross.
ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b);

/// Derivative of the distance, for the two nearest parts; a ridge if others are as near and have
/// another derivative. If surfaces cross, the derivative is zero
/// and marked as a ridge: a pose where the distance has no derivative.
PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b);
/// Same as derivative_at_half_space() for shapes. A mesh is on a ridge if several vertices are
/// lowest, a compound if several parts are.
PairDerivative derivative_at_half_space(const Vec3<double>& origin, const PartsBody& b,
                                        const Affine<double>& pose_b, const SignedDistance& found,
                                        PairDerivativeError* error = nullptr,
                                        const Drift& drift = {});
/// Derivative of the time of impact; a ridge if other parts, which touch at that time, have another
/// one.
PairDerivative derivative_of(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                             const RigidMotion& motion_b, double t_max);

}  // namespace minkray
