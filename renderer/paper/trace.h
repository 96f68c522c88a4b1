// SPDX-License-Identifier: MIT
// Iterations of a solver as clipping steps, for --trace and `minkray trace`.
#pragma once

#include <vector>

#include "core/cast/cast.h"
#include "renderer/json/json.h"
#include "renderer/paper/clipping.h"

namespace minkray {

/// One iteration, copied; in the letters and the frame of CastIteration.
struct TracedIteration {
  double lambda;
  Vec3<double> x, v, p, w;
  std::vector<Vec3<double>> simplex;
  Clip<double> clip;
  double lower, upper;  ///< bounds of lambda so far, from all planes together
};

struct CastTrace {
  RayNearBall<double> ray;  ///< in the inner frame, relative to the ball's centre
  Ball<double> ball;
  std::vector<TracedIteration> iterations;
  CastResult<double> result;

  /// The ray's own parameter at lambda.
  double t(double lambda) const { return double(ray.t_base) + double(ray.t_offset(lambda)); }
};

/// Casts and keeps every iteration.
CastTrace trace_ray(const PreparedShape& shape, const Ray<double>& ray, const CastOptions& options);

/// The iterations as a list of objects.
Json trace_json(const CastTrace& trace);

}  // namespace minkray
