// SPDX-License-Identifier: MIT
// Iterations of a solver as clipping steps, for --trace and `minkray trace`.
#pragma once

#include <vector>

#include "core/cast/cast.h"
#include "core/gjk/clipping.h"
#include "renderer/json/json.h"

namespace minkray {

/// One iteration, copied; in the letters and the frame of CastIteration.
template <class T>
struct TracedIteration {
  T lambda;
  Vec3<T> x, v, p, w;
  std::vector<Vec3<T>> simplex;
  Clip<T> clip;
  T lower, upper;  ///< bounds of lambda so far, from all planes together
};

template <class T>
struct CastTrace {
  RayNearBall<T> ray;  ///< in the inner frame, relative to the ball's centre
  Ball<T> ball;
  std::vector<TracedIteration<T>> iterations;
  CastResult<T> result;

  /// The ray's own parameter at lambda.
  double t(T lambda) const { return double(ray.t_base) + double(ray.t_offset(lambda)); }
};

/// Casts and keeps every iteration.
template <class T>
CastTrace<T> trace_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options);

/// The iterations as a list of objects.
template <class T>
Json trace_json(const CastTrace<T>& trace);

}  // namespace minkray
