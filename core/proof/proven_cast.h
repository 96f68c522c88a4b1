// SPDX-License-Identifier: MIT
// Proves results with certificates (certificate.h) before they are returned, for shapes whose
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
  /// True if the proof holds within the rounding of single points. A larger tolerance applies to
  /// `holds`, for points in the middle of slivers.
  bool is_sharp = false;
};

/// Tries to prove `answer` by a certificate. A hit is moved to the point that its certificate
/// spans, if there is one. `near` is relative to the ball's centre, the ball must contain the
/// shape, and the normal is in the shape's frame. Spanned points are searched from the claimed
/// point on, up to the rounding along the ray; if `before`, also up to the same distance before the
/// claimed point.
ProvenCast proven(const Shape& shape, const Ball<double>& ball, const RayNearBall<double>& near,
                  const CastResult<double>& answer, bool before = false);

}  // namespace minkray
