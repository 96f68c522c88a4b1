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

template <class T>
struct CastOptions {
  SolverKind solver = SolverKind::automatic;
  /// The paper's eps_tol, for the solvers that have one: a relative tolerance of squared lengths.
  T eps_tol = tolerance::gjk_squared<T>;
  int max_iterations = tolerance::gjk_max_iterations;
  /// Initial normal in the ray's frame, for solvers that take one: for example, that of the
  /// previous image's separating plane. Zero: none.
  Vec3<T> v0 = Vec3<T>::Zero();
};

template <class T>
using CastObserver = std::function<void(const CastIteration<T>&)>;

/// Finds where the ray enters the shape: the least t in [0, t_max] at which origin + t * direction
/// lies in it. If the origin is in the shape, the status is inside and t = 0. Numbers must be
/// finite; t_max may be infinite. The observer, if any, receives every iteration, in the inner
/// frame (see PreparedShape).
template <class T>
CastResult<T> cast_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options = {}, const CastObserver<T>& observer = {});

/// Casts at a shape whose pose is used for this ray only: faster, as closed forms need no prepared
/// shape.
CastResult<double> cast_ray(const ShapeDefinition<double>& definition, const Affine<double>& pose,
                            const Ray<double>& ray);

/// Finds where the ray leaves the shape: the greatest t in [0, t_max] whose point lies in the
/// shape. Status hit: the ray leaves at t. Inside: the point at t = t_max is still in the shape.
/// Miss: the ray misses the shape.
template <class T>
CastResult<T> cast_exit(const PreparedShape<T>& shape, const Ray<T>& ray,
                        const CastOptions<T>& options = {});

extern template CastResult<float> cast_ray(const PreparedShape<float>&, const Ray<float>&,
                                           const CastOptions<float>&, const CastObserver<float>&);
extern template CastResult<double> cast_ray(const PreparedShape<double>&, const Ray<double>&,
                                            const CastOptions<double>&,
                                            const CastObserver<double>&);
extern template CastResult<float> cast_exit(const PreparedShape<float>&, const Ray<float>&,
                                            const CastOptions<float>&);
extern template CastResult<double> cast_exit(const PreparedShape<double>&, const Ray<double>&,
                                             const CastOptions<double>&);

}  // namespace minkray
