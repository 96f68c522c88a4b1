// SPDX-License-Identifier: MIT
// Checks results with the proofs of certificate.h before they are returned: for shapes whose error
// a solver's own rounding does not bound.
#pragma once

#include "core/math/bounds.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

struct ProvenCast {
  CastResult<double> answer;
  bool holds = false;
  /// Holds, and the spanned point (or the plane of a miss) is off by the rounding of points only,
  /// without the larger tolerance for the middles of slivers.
  bool is_sharp = false;
};

/// Returns the answer with the result of its certificate. A hit moves to the point that its
/// certificate spans, if there is one. `near` is relative to the ball's centre, the ball must
/// contain the shape, and the normal is in the shape's frame. The spanned point is searched from
/// the claimed one on, up to the rounding along the ray beyond it; if `before`, from as far before
/// it.
ProvenCast proven(const Shape<double>& shape, const Ball<double>& ball,
                  const RayNearBall<double>& near, const CastResult<double>& answer,
                  bool before = false);

}  // namespace minkray
