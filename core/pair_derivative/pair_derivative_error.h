// SPDX-License-Identifier: MIT
// Bounds of the errors of a distance's derivative (docs/pairs.md, "Errors of derivatives"): from
// what the distance's bounds leave to the direction, and how far support points slide meanwhile.
#pragma once

#include "core/pair_derivative/pair_derivative_sharpen.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// The length of the difference from the true derivative is no more. Infinite where nothing is
/// known: on ridges, of depths in more than one direction, of turns about what may slide.
struct TwistError {
  double by_velocity = std::numeric_limits<double>::infinity();
  double by_turn = std::numeric_limits<double>::infinity();
};

struct PairDerivativeError {
  TwistError a, b;
};

/// Bounds of the movement since the contact: the way of any point of the bodies, and their turns.
struct Drift {
  double way = 0, turn = 0;
};

/// `contact` is what the derivative was made of. Directions of a depth lean by `depth_tilt` at
/// most, which is infinite where that is not known. `origin_a` and `origin_b` are the bodies'
/// origins, seen from A's middle. Holds for all poses that are no further than `drift`.
PairDerivativeError error_of(const CoresInWorld& cores, const CoreContact& contact,
                             const SignedDistance& found, double depth_tilt,
                             const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                             const Drift& drift = {});

/// A is a half-space whose normal may lean by `tilt`; `down` is the opposite of it in the frame of
/// B's core. The bodies' origins are in the frame of the points that were found.
PairDerivativeError error_at_half_space(const ShapeCore& core_b, const Vec3<double>& down,
                                        double tilt, const SignedDistance& found,
                                        const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                                        const Drift& drift = {});

}  // namespace minkray
