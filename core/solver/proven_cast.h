// SPDX-License-Identifier: MIT
// Answers that are looked at again, with the proofs of certificate.h, before they are given: where
// a solver's own rounding is no measure of them.
#pragma once

#include "core/math/bounds.h"
#include "core/shape/shape.h"
#include "core/solver/ray_near_ball.h"
#include "core/solver/result.h"

namespace minkray {

/// Hits are moved to between the bounds of their certificate, where there is one. Otherwise
/// `answer` as it is. `near` is relative to the ball's centre, the ball holds the shape, and the
/// normal is in the shape's frame.
struct ProvenCast {
  CastResult<double> answer;
  bool holds = false;
};
ProvenCast proven(const Shape<double>& shape, const Ball<double>& ball,
                  const RayNearBall<double>& near, const CastResult<double>& answer);

}  // namespace minkray
