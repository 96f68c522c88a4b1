// SPDX-License-Identifier: MIT
// Error bounds of a distance's derivative (docs/pairs.md, "Errors of derivatives"). Computed from
// the range of directions that the distance's bounds allow, and from the slide of support points
// within this range.
#pragma once

#include "core/pair_derivative/pair_derivative_sharpen.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// Upper bounds of the length of the difference from the true derivative. Infinite if unknown: on
/// ridges, for depths in several directions, and for turns if the nearest points may slide along an
/// edge or a face.
struct TwistError {
  double by_velocity = std::numeric_limits<double>::infinity();
  double by_turn = std::numeric_limits<double>::infinity();
};

struct PairDerivativeError {
  TwistError a, b;
};

/// Bounds of the bodies' motion after the time of the given result: the displacement of any of
/// their points, and their rotation in radians.
struct Drift {
  double way = 0, turn = 0;
};

/// Bounds the error of a derivative that was computed from `contact`. `depth_tilt` bounds the error
/// of a depth's direction (infinite if unknown). `origin_a` and `origin_b` are the bodies' origins
/// relative to A's middle. The bound holds for all poses within `drift`.
PairDerivativeError error_of(const CoresInWorld& cores, const CoreContact& contact,
                             const SignedDistance& found, double depth_tilt,
                             const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                             const Drift& drift = {});

/// Same for A a half-space, if the error of its normal is at most `tilt`. `down` is the opposite of
/// the normal, in the frame of B's core. The bodies' origins are in the same frame as the points of
/// `found`.
PairDerivativeError error_at_half_space(const ShapeCore& core_b, const Vec3<double>& down,
                                        double tilt, const SignedDistance& found,
                                        const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                                        const Drift& drift = {});

}  // namespace minkray
