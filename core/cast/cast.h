// SPDX-License-Identifier: MIT
// Casts a ray at a shape with any of the solvers.
#pragma once

#include "core/cast/prepared_shape.h"
#include "core/cast/solver.h"
#include "core/math/ray.h"
#include "core/query/observer.h"
#include "core/query/result.h"
#include "core/query/tolerances.h"

namespace minkray {

struct CastOptions {
  const Solver* solver = &solver::automatic;
  /// Relative tolerance of squared lengths, for solvers that use one (eps_tol in van den Bergen,
  /// 2004).
  double eps_tol = tolerance::gjk_squared<double>;
  int max_iterations = tolerance::gjk_max_iterations;
  /// Initial normal in the ray's frame, for solvers that use one. For example, the normal of the
  /// plane that separated ray and shape in the previous picture of an animation. Zero for none.
  Vec3<double> v0 = Vec3<double>::Zero();
};

/// Finds where the ray enters the shape: the least t in [0, t_max] at which origin + t * direction
/// lies in the shape. If the origin is in the shape, the status is inside and t = 0. Numbers must
/// be finite; t_max may be infinite. The observer, if any, receives every iteration of the solver,
/// in the shape's inner frame (see PreparedShape).
CastResult<double> cast_ray(const PreparedShape& shape, const Ray<double>& ray,
                            const CastOptions& options = {}, const CastObserver& observer = {});

/// Casts at a shape whose pose is used for this ray only. Faster than making a PreparedShape first,
/// since a closed form does not need one.
CastResult<double> cast_ray(const ShapeDefinition& definition, const Affine<double>& pose,
                            const Ray<double>& ray);

/// Finds where the ray leaves the shape: the greatest t in [0, t_max] at which origin + t *
/// direction lies in the shape. Status hit: the ray leaves the shape at t. Inside: the ray's end,
/// at t_max, is in the shape. Miss: the ray misses the shape.
CastResult<double> cast_exit(const PreparedShape& shape, const Ray<double>& ray,
                             const CastOptions& options = {});

/// Same as cast_exit, but also bounds t from below. `offset_lo` is -infinity if no bound is known.
CastResult<double> cast_exit_within(const PreparedShape& shape, const Ray<double>& ray,
                                    const CastOptions& options = {});

}  // namespace minkray
