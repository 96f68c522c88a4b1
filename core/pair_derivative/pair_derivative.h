// SPDX-License-Identifier: MIT
// Derivatives of a pair's signed distance, and of the time of its first contact, with respect to
// the bodies' motion. By the envelope theorem the nearest points can be treated as fixed on the
// bodies (J. Danskin, "The Theory of Max-Min, with Applications", 1966). With several pairs of
// nearest points, or several directions of the depth, there are several derivatives.
#pragma once

#include <algorithm>

#include "core/pair_derivative/pair_derivative_error.h"
#include "core/pair_distance/half_space_distance.h"
#include "core/pair_motion/impact.h"

namespace minkray {

/// Derivatives with respect to the velocity of the body's origin along the world's axes, and to its
/// angular velocity about that point.
struct TwistDerivative {
  Vec3<double> by_velocity = Vec3<double>::Zero();
  Vec3<double> by_turn = Vec3<double>::Zero();
};

struct PairDerivative {
  TwistDerivative a, b;
  /// True if there may be several derivatives; `a` and `b` then have one of them.
  bool is_ridge = false;
};

/// Returns the options, changed for queries whose results are used for derivatives.
inline SignedDistanceOptions for_derivatives(SignedDistanceOptions options = {}) {
  constexpr double coarsest = 1e-10;
  options.tolerance = std::min(options.tolerance, coarsest);
  options.is_for_derivatives = true;
  return options;
}

/// Returns the derivative of the signed distance. `found` must be the pair's distance, computed
/// with for_derivatives(), and have both bounds; otherwise the derivative is NaN and marked as a
/// ridge. Writes an error bound to `error` if this is not null. The error bound holds for all poses
/// within `drift` of the given ones.
PairDerivative derivative_of(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b,
                             const SignedDistance& found, PairDerivativeError* error = nullptr,
                             const Drift& drift = {});

/// Computes the signed distance as accurately as the derivative needs, and then the derivative.
PairDerivative finest_derivative_of(const ContactShape& a, const Affine<double>& pose_a,
                                    const ContactShape& b, const Affine<double>& pose_b,
                                    PairDerivativeError* error = nullptr);

/// Same for A a half-space, whose body has its origin at `origin`. `found` must be the result of
/// distance_to_half_space() for the shape B.
PairDerivative derivative_at_half_space(const Vec3<double>& origin, const ContactShape& b,
                                        const Affine<double>& pose_b, const SignedDistance& found,
                                        PairDerivativeError* error = nullptr,
                                        const Drift& drift = {});

/// The region of a pair's nearest points: a point, a segment along `along`, or a polygon
/// perpendicular to the normal.
struct ContactRegion {
  int dimension = 0;
  Vec3<double> along = Vec3<double>::UnitZ();
};

/// Returns the region that makes the pair a ridge: all nearest points are in it, and have the same
/// normal. Dimension 0 if there is another reason, such as a depth in several directions. `found`
/// is as for derivative_of().
ContactRegion contact_region(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b,
                             const SignedDistance& found);

/// Same for a half-space and the shape B.
ContactRegion region_at_half_space(const ContactShape& b, const Affine<double>& pose_b,
                                   const SignedDistance& found);

/// Returns the derivative of the time of impact, t_lo of `found`, with respect to a small motion
/// (twist) of each body at time 0. Zero if the bodies overlap at time 0; NaN without contact.
PairDerivative derivative_of(const ContactShape& a, const RigidMotion& motion_a,
                             const ContactShape& b, const RigidMotion& motion_b,
                             const Impact& found);

}  // namespace minkray
