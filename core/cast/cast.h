// SPDX-License-Identifier: MIT
// Casts a ray at a shape with any of the solvers.
#pragma once

#include <functional>

#include "core/cast/prepared_shape.h"
#include "core/math/ray.h"
#include "core/query/observer.h"
#include "core/query/result.h"
#include "core/query/solver_kind.h"
#include "core/query/tolerances.h"

namespace minkray {

struct CastOptions {
  SolverKind solver = SolverKind::automatic;
  /// The paper's eps_tol, for the solvers that have one: a relative tolerance of squared lengths.
  double eps_tol = tolerance::gjk_squared<double>;
  int max_iterations = tolerance::gjk_max_iterations;
  /// Initial normal in the ray's frame, for solvers that take one: for example, that of the
  /// previous image's separating plane. Zero: none.
  Vec3<double> v0 = Vec3<double>::Zero();
};

using CastObserver = std::function<void(const CastIteration<double>&)>;

/// Finds where the ray enters the shape: the least t in [0, t_max] at which origin + t * direction
/// lies in it. If the origin is in the shape, the status is inside and t = 0. Numbers must be
/// finite; t_max may be infinite. The observer, if any, receives every iteration, in the inner
/// frame (see PreparedShape).
CastResult<double> cast_ray(const PreparedShape& shape, const Ray<double>& ray,
                            const CastOptions& options = {}, const CastObserver& observer = {});

/// Casts at a shape whose pose is used for this ray only: faster, as closed forms need no prepared
/// shape.
CastResult<double> cast_ray(const ShapeDefinition& definition, const Affine<double>& pose,
                            const Ray<double>& ray);

/// Finds where the ray leaves the shape: the greatest t in [0, t_max] whose point lies in the
/// shape. Status hit: the ray leaves at t. Inside: the point at t = t_max is still in the shape.
/// Miss: the ray misses the shape.
CastResult<double> cast_exit(const PreparedShape& shape, const Ray<double>& ray,
                             const CastOptions& options = {});

}  // namespace minkray
