// SPDX-License-Identifier: MIT
// Proves results with certificates (certificate.h) before they are returned. For shapes whose
// errors exceed the rounding that solvers assume.
#pragma once

#include "core/math/bounds.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

struct ProvenCast {
  CastResult<double> answer;
  bool holds = false;
  /// True if the proof holds with the tolerance for the rounding of points alone, without the
  /// larger tolerance for the middles of slivers.
  bool is_sharp = false;
};

/// Returns the result with the verdict on its certificate. A hit moves to the point that its
/// certificate spans, if any. `near` is relative to the ball's centre, the ball must contain the
/// shape, and the normal is in the shape's frame. The search for the spanned point goes from the
/// claimed point to the rounding along the ray beyond it; if `before`, also as far before the
/// claimed point.
ProvenCast proven(const Shape& shape, const Ball<double>& ball, const RayNearBall<double>& near,
                  const CastResult<double>& answer, bool before = false);

}  // namespace minkray
