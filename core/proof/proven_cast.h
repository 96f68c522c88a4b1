// SPDX-License-Identifier: MIT
// Results that are checked again, with the proofs of certificate.h, before they are returned:
// where a solver's own rounding is no measure of them.
#pragma once

#include "core/math/bounds.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

struct ProvenCast {
  CastResult<double> answer;
  bool holds = false;
  /// Holds, and the point it spans is off by points' rounding alone, without the more that the
  /// middles of slivers are allowed; or the plane, of a miss.
  bool is_sharp = false;
};

/// The answer, and whether and how well a certificate of it holds. A hit is moved to the point that
/// its certificate spans, if it has one. `near` is relative to the ball's centre, the ball holds
/// the shape, and the normal is in the shape's frame. A point that the ray passes is looked for at
/// the claimed one, and beyond it as far as rounding is along the ray; if `before`, as far before.
ProvenCast proven(const Shape<double>& shape, const Ball<double>& ball,
                  const RayNearBall<double>& near, const CastResult<double>& answer,
                  bool before = false);

}  // namespace minkray
