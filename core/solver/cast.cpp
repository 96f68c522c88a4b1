// SPDX-License-Identifier: MIT
// The one place where solvers meet shapes: every solver is compiled here, for every shape.
#include "core/solver/cast.h"

#include "core/solver/first_solution.h"
#include "core/solver/gjk_ray_cast.h"
#include "core/solver/model_of.h"
#include "core/solver/subalgorithm.h"

namespace minkray {
namespace {

template <class T>
GjkCastOptions<T> gjk_options(const PreparedShape<T>& shape, const CastOptions<T>& options) {
  GjkCastOptions<T> gjk{options.eps_tol, options.max_iterations, options.v0};
  if (!gjk.v0.isZero(T(0))) gjk.v0 = shape.normal_to_inner(gjk.v0);
  return gjk;
}

/// The reference solvers, which are not worth compiling for every shape: they see Shape<T>.
template <class T, class Observer>
CastResult<T> cast_reference(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                             const CastOptions<T>& options, Observer&& observer) {
  const Shape<T>& any = shape.inner_shape();
  const GjkCastOptions<T> gjk = gjk_options(shape, options);
  switch (options.solver) {
    case SolverKind::first_solution:
      return first_solution(any, near, shape.inner_ball(), tolerance::first_solution_max_supports,
                            observer);
    case SolverKind::paper_johnson:
      return gjk_ray_cast(any, near, shape.inner_ball(), gjk, observer,
                          JohnsonSubalgorithm<T, 3>());
    default:
      return gjk_ray_cast(any, near, shape.inner_ball(), gjk, observer,
                          SignedVolumesSubalgorithm<T, 3>());
  }
}

constexpr bool is_reference(SolverKind kind) {
  return kind == SolverKind::first_solution || kind == SolverKind::paper_johnson ||
         kind == SolverKind::paper_signed_volumes;
}

/// With models; where they give up, the GJK ray cast.
template <class T, class Observer>
CastResult<T> cast_with_model(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                              const CastOptions<T>& options, Observer&& observer) {
  const Ball<T>& ball = shape.inner_ball();
  const auto cast = [&](int max_iterations) {
    return [&, max_iterations](const auto& make_model) {
      return result_of(model_cast<T>(make_model, near, ball, shape.inner_half_extents(), true,
                                     max_iterations, observer));
    };
  };
  const Shape<T>& any = shape.inner_shape();
  const auto portal = [&] {
    return cast(tolerance::portal_max_iterations)([&](const Vec3<T>& s, const Vec3<T>& r) {
      return PolytopeModel<T, Shape<T>>(any, ball.centre, s, r, ball.radius);
    });
  };
  const auto model_and_cast = [&] {
    if (options.solver == SolverKind::portal) return portal();
    return with_model<T>(shape.definition(), cast(tolerance::jet_max_iterations));
  };
  const auto after = [](const CastResult<T>& first, CastResult<T> then) {
    then.iterations += first.iterations;
    then.supports += first.supports;
    return then;
  };
  CastResult<T> result = model_and_cast();
  if (result.status == Status::exhausted)
    result = after(result, gjk_ray_cast(any, near, ball, gjk_options(shape, options), observer));
  // Rays along edges between flat and curved, where the simplices of the GJK ray cast are slivers.
  if (result.status == Status::exhausted && options.solver != SolverKind::portal)
    result = after(result, portal());
  return result;
}

/// By measurement, see docs/decisions/0002-automatic-solver.md.
template <class T>
SolverKind best_solver(const PreparedShape<T>& shape) {
  return shape.model() == ModelKind::osculated_parts ? SolverKind::paper : SolverKind::jet;
}

/// With one solver; the normal is in the inner frame.
template <class T, class Observer>
CastResult<T> cast_with(SolverKind solver, const PreparedShape<T>& shape,
                        const RayNearBall<T>& near, const CastOptions<T>& options,
                        Observer&& observer) {
  if (is_reference(solver)) return cast_reference(shape, near, options, observer);
  if (solver == SolverKind::portal || solver == SolverKind::jet)
    return cast_with_model(shape, near, options, observer);
  return std::visit(
      [&](const auto& kind) {
        return gjk_ray_cast(kind, near, shape.inner_ball(), gjk_options(shape, options), observer);
      },
      shape.inner_shape().kind);
}

template <class T, class Observer>
CastResult<T> cast_near(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                        const CastOptions<T>& options, Observer&& observer) {
  const bool automatic = options.solver == SolverKind::automatic;
  const SolverKind solver = automatic ? best_solver(shape) : options.solver;
  CastResult<T> result = cast_with(solver, shape, near, options, observer);
  // The jet cast hands over to the GJK ray cast by itself; the other way round it is done here.
  if (automatic && solver == SolverKind::paper && result.status == Status::exhausted) {
    const CastResult<T> first = result;
    result = cast_with(SolverKind::jet, shape, near, options, observer);
    result.iterations += first.iterations;
    result.supports += first.supports;
  }
  // A direction so short that the hit's t is no number of T.
  if (result.status == Status::hit && !std::isfinite(result.t())) result.status = Status::exhausted;
  // Of a point all directions are normals.
  if (result.status == Status::hit && result.normal.isZero(T(0))) result.normal = -near.r;
  result.normal = shape.normal_to_outer(result.normal);
  // Where the ray's distance in the shape's own frame overflows.
  const bool has_numbers = !std::isnan(result.t_base) && !std::isnan(result.t_offset) &&
                           !std::isnan(result.offset_lo) && !std::isnan(result.offset_hi);
  if (!has_numbers || !result.normal.allFinite()) {
    result.status = Status::exhausted;
    result.normal.setZero();
  }
  return result;
}

}  // namespace

template <class T>
CastResult<T> cast_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options, const CastObserver<T>& observer) {
  const RayNearBall<T> near = shape.to_inner(ray);
  CastResult<T> result = observer ? cast_near(shape, near, options, observer)
                                  : cast_near(shape, near, options, NoObserver());
  if (result.status == Status::inside)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = T(0);
  return result;
}

template <class T>
CastResult<T> cast_exit(const PreparedShape<T>& shape, const Ray<T>& ray,
                        const CastOptions<T>& options) {
  CastResult<T> result = cast_near(shape, shape.to_inner(ray).reversed(), options, NoObserver());
  std::swap(result.offset_lo, result.offset_hi);
  if (result.status == Status::hit) result.offset_lo = -std::numeric_limits<T>::infinity();
  return result;
}

template CastResult<float> cast_ray(const PreparedShape<float>&, const Ray<float>&,
                                    const CastOptions<float>&, const CastObserver<float>&);
template CastResult<double> cast_ray(const PreparedShape<double>&, const Ray<double>&,
                                     const CastOptions<double>&, const CastObserver<double>&);
template CastResult<float> cast_exit(const PreparedShape<float>&, const Ray<float>&,
                                     const CastOptions<float>&);
template CastResult<double> cast_exit(const PreparedShape<double>&, const Ray<double>&,
                                      const CastOptions<double>&);

}  // namespace minkray
