// SPDX-License-Identifier: MIT
// Proves results of casts with certificates (certificate.h) before the results are returned, for
// shapes whose errors exceed the rounding that solvers assume.
#pragma once

#include "core/math/bounds.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

struct ProvenCast {
  CastResult<double> answer;
  bool holds = false;
  /// True if the proof holds to within the rounding of single points. `holds` allows larger errors,
  /// such as those of points in the middle of sliver triangles.
  bool is_sharp = false;
};

/// Tries to prove `answer` by a certificate. A hit is moved to the point of the ray that its
/// certificate proves to be in the shape, if there is one. The ball must contain the shape, `near`
/// is the ray relative to the ball's centre, and the normal is in the shape's frame. The search for
/// such a point extends from the hit along the ray, by the rounding along the ray; if `before`,
/// also by the same distance backwards.
ProvenCast proven(const Shape& shape, const Ball<double>& ball, const RayNearBall<double>& near,
                  const CastResult<double>& answer, bool before = false);

}  // namespace minkray
