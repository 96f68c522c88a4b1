// SPDX-License-Identifier: MIT
// Continuous collision detection of rotating bodies, by the approximation of van den Bergen (2004),
// section 1: orientations change in fixed steps, and positions are interpolated.
#pragma once

#include "core/pair_motion/impact.h"
#include "renderer/paper/shape_cast.h"

namespace minkray {

struct RotatingCastResult {
  Status status = Status::exhausted;
  double t = 0.0;       ///< first contact of the approximated motion
  double t_lo = 0.0;    ///< no true contact before this time
  bool proven = false;  ///< true for a miss if the true motion is proven to have no contact either
  double position_error = 0.0;  ///< bound of the gap or overlap of the true bodies at t
  Vec3<double> point_a = Vec3<double>::Zero(), point_b = Vec3<double>::Zero(),
               normal = Vec3<double>::Zero();
  int steps = 0;  ///< number of steps that were cast
  int iterations = 0;
  int supports = 0;
};

/// Finds the first contact of A and B, whose poses may be any invertible maps, at times from 0 to
/// duration, in `steps` equal steps.
///
/// Within a step of length h, each orientation is that of the step's middle. The error of a point
/// at distance rho from its body's pivot is at most 2 rho sin(|omega| h / 4) <= rho |omega| h / 2;
/// `position_error` is the sum of the errors of the two bodies. t is the result for the
/// approximated motion. A second cast uses the obstacle grown by position_error; its first contact
/// is never later than the true contact, and gives the proven bound t_lo.
RotatingCastResult cast_rotating(const Shape& a, const RigidMotion& motion_a, const Shape& b,
                                 const RigidMotion& motion_b, double duration, int steps,
                                 const CastOptions& options = {});

}  // namespace minkray
