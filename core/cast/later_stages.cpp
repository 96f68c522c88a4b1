// SPDX-License-Identifier: MIT
// The one place where solvers meet shapes: every solver is compiled here, for every shape.
#include "core/cast/later_stages.h"

#include <optional>

#include "core/derived/convert.h"
#include "core/gjk/first_solution.h"
#include "core/gjk/gjk_ray_cast.h"
#include "core/gjk/subalgorithm.h"
#include "core/model/model_of.h"
#include "core/proof/proven_cast.h"

namespace minkray {
namespace {

template <class T>
GjkCastOptions<T> gjk_options(const PreparedShape<T>& shape, const CastOptions<T>& options) {
  GjkCastOptions<T> gjk{options.eps_tol, options.max_iterations, options.v0};
  if (!gjk.v0.isZero(T(0))) gjk.v0 = shape.normal_to_inner(gjk.v0);
  return gjk;
}

/// Named by the stage it comes from.
template <class T>
CastResult<T> by(Path path, CastResult<T> result) {
  result.path = path;
  return result;
}

/// The reference solvers, which are not worth compiling for every shape: they see Shape<T>.
template <class T, class Observer>
CastResult<T> cast_reference(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                             const CastOptions<T>& options, Observer&& observer) {
  const Shape<T>& any = shape.inner_shape();
  const GjkCastOptions<T> gjk = gjk_options(shape, options);
  const auto answer = [&] {
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
  };
  return by(Path::gjk, answer());
}

constexpr bool is_reference(SolverKind kind) {
  return kind == SolverKind::first_solution || kind == SolverKind::paper_johnson ||
         kind == SolverKind::paper_signed_volumes;
}

/// What was spent before is counted as well.
template <class T>
CastResult<T> after(const CastResult<T>& first, CastResult<T> then) {
  then.iterations += first.iterations;
  then.supports += first.supports;
  return then;
}

template <class T>
CastResult<T> miss_of(const Vec3<T>& normal) {
  CastResult<T> result;
  result.status = Status::miss;
  result.normal = normal;
  result.offset_hi = T(0);
  return result;
}

/// With models, of a ray that meets the bounding ball; where they give up, the GJK ray cast.
template <class T, class Observer>
CastResult<T> cast_in_ball(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                           bool is_castable, const CastOptions<T>& options, Observer&& observer) {
  const Ball<T>& ball = shape.inner_ball();
  const auto cast = [&](int max_iterations) {
    return [&, max_iterations](const auto& make_model) {
      CastLanes<T> lanes = model_cast<T>(make_model, near, ball, shape.inner_half_extents(), true,
                                         max_iterations, observer);
      if (lanes.doubtful && !shape.definition().is_smooth()) lanes.inside = false;
      return result_of(lanes);
    };
  };
  const Shape<T>& any = shape.inner_shape();
  const auto portal = [&] {
    return cast(tolerance::portal_max_iterations)([&](const Vec3<T>& s, const Vec3<T>& r) {
      return PolytopeModel<T, Shape<T>>(any, ball.centre, s, r, ball.radius);
    });
  };
  const auto model_and_cast = [&] {
    if (!is_castable) return CastResult<T>();
    if (options.solver == SolverKind::portal) return portal();
    return with_model<T>(shape.definition(), cast(tolerance::jet_max_iterations));
  };
  CastResult<T> result = model_and_cast();
  if (result.status == Status::exhausted)
    result =
        by(Path::gjk,
           after(result, gjk_ray_cast(any, near, ball, gjk_options(shape, options), observer)));
  // Rays along edges between flat and curved, where the simplices of the GJK ray cast are slivers.
  if (result.status == Status::exhausted && options.solver != SolverKind::portal && is_castable)
    result = after(result, portal());
  return result;
}

template <class T, class Observer>
CastResult<T> cast_with_model(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                              const CastOptions<T>& options, Observer&& observer) {
  BoundsCast<T> bounds{true, false, Vec3<T>::Zero()};
  cast_at_ball(near, shape.inner_ball().radius, bounds);
  if (bounds.miss) return miss_of(bounds.normal);
  return cast_in_ball(shape, near, bounds.open, options, observer);
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
        return by(Path::gjk, gjk_ray_cast(kind, near, shape.inner_ball(),
                                          gjk_options(shape, options), observer));
      },
      shape.inner_shape().kind);
}

template <class To, class From>
RayNearBall<To> in_precision(const RayNearBall<From>& near) {
  return {near.s.template cast<To>(),
          near.r.template cast<To>(),
          To(near.lambda_min),
          To(near.lambda_max),
          To(near.t_base),
          To(near.t_shift),
          To(near.t_per_length)};
}

template <class To, class From>
CastResult<To> in_precision(const CastResult<From>& found) {
  return {found.status,
          found.path,
          To(found.t_base),
          To(found.t_offset),
          To(found.offset_lo),
          To(found.offset_hi),
          found.normal.template cast<To>(),
          found.iterations,
          found.supports};
}

CastOptions<double> in_double(const CastOptions<float>& options) {
  CastOptions<double> other;
  other.solver = options.solver;
  if (options.eps_tol != CastOptions<float>().eps_tol) other.eps_tol = options.eps_tol;
  other.max_iterations = options.max_iterations;
  other.v0 = options.v0.cast<double>();
  return other;
}

/// The normal is in the inner frame.
template <class T, class Observer>
CastResult<T> cast_inner(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                         const CastOptions<T>& options, Observer&& observer) {
  const bool automatic = options.solver == SolverKind::automatic;
  const SolverKind solver = automatic ? best_solver(shape) : options.solver;
  CastResult<T> result = cast_with(solver, shape, near, options, observer);
  // The jet cast hands over to the GJK ray cast by itself; the other way round it is done here.
  if (automatic && solver == SolverKind::paper && result.status == Status::exhausted)
    result = after(result, cast_with(SolverKind::jet, shape, near, options, observer));
  // Of a point all directions are normals.
  const bool is_point = !(shape.inner_ball().radius > T(0));
  if (result.status == Status::hit && (is_point || result.normal.isZero(T(0))))
    result.normal = -near.r;
  return result;
}

template <class T, class Observer>
CastResult<T> cast_near(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                        const CastOptions<T>& options, Observer&& observer);

/// The GJK ray cast with more digits, for slivers; the answer's t_base is near.t_base.
template <class Finer, class T>
CastResult<double> cast_finer(const Shape<Finer>& shape, const Ball<T>& ball,
                              const RayNearBall<T>& near) {
  // Mapped, though to itself: r is of unit length to the wider numbers' rounding then.
  const RayNearBall<Finer> finer = in_precision<Finer>(near).mapped(Mat3<Finer>::Identity());
  return in_precision<double>(gjk_ray_cast(
      shape, finer, Ball<Finer>{ball.centre.template cast<Finer>(), Finer(ball.radius)}));
}

/// Where all solvers gave up, as where an edge or a rim is touched: with more digits, if the answer
/// can be proven then. Else `first`.
template <class T>
CastResult<T> replace_exhausted(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                                const CastResult<T>& first) {
  using Finer = std::conditional_t<std::is_same_v<T, float>, double, long double>;
  const Ball<double> ball{shape.inner_ball().centre.template cast<double>(),
                          double(shape.inner_ball().radius)};
  const RayNearBall<double> near_in_double = in_precision<double>(near);
  const Shape<Finer> finer = convert<Finer>(shape.inner_shape());
  const Shape<double>& same = [&]() -> const Shape<double>& {
    if constexpr (std::is_same_v<T, float>)
      return finer;
    else
      return shape.inner_shape();
  }();
  int iterations = first.iterations, supports = first.supports;
  CastResult<T> result = first;
  const auto proves = [&](const CastResult<double>& answer) {
    const ProvenCast cast = proven(same, ball, near_in_double, answer);
    iterations += cast.answer.iterations;
    supports += cast.answer.supports;
    if (cast.holds) result = by(Path::finer, in_precision<T>(cast.answer));
    return cast.holds;
  };
  CastResult<double> claim = in_precision<double>(first);
  claim.status = Status::hit;
  claim.iterations = claim.supports = 0;
  if (!proves(cast_finer(finer, shape.inner_ball(), near)) && !claim.normal.isZero(0))
    proves(claim);
  result.iterations = iterations;
  result.supports = supports;
  return result;
}

/// The first of `first` and other solvers' answers that has a sharp proof; else one that has any
/// proof. If none has, `first`: at shapes of extreme proportions as exhausted.
template <class Observer>
CastResult<double> prove_or_replace(const PreparedShape<double>& shape,
                                    const RayNearBall<double>& near,
                                    const CastOptions<double>& options,
                                    const CastResult<double>& first, Observer&& observer) {
  std::optional<ProvenCast> best;
  int iterations = 0, supports = 0;
  const auto proves_sharply = [&](const CastResult<double>& answer) {
    const ProvenCast cast = proven(shape.inner_shape(), shape.inner_ball(), near, answer);
    if (!best || cast.is_sharp || (cast.holds && !best->holds)) best = cast;
    iterations += cast.answer.iterations;
    supports += cast.answer.supports;
    return cast.is_sharp;
  };
  const auto others_prove = [&] {
    if (options.solver != SolverKind::automatic && options.solver != SolverKind::jet) return false;
    const Shape<long double>* exact = shape.definition().in_long_double();
    return proves_sharply(cast_with(SolverKind::paper, shape, near, options, observer)) ||
           (exact && proves_sharply(cast_finer(*exact, shape.inner_ball(), near)));
  };
  if (!proves_sharply(first)) others_prove();
  best->answer.iterations = iterations;
  best->answer.supports = supports;
  best->answer.path = Path::finer;
  if (!best->holds && shape.definition().is_extreme()) best->answer.status = Status::exhausted;
  return best->answer;
}

/// At a float shape of extreme proportions: the cast in double.
template <class Observer>
CastResult<float> cast_through_double(const PreparedShape<float>& shape,
                                      const RayNearBall<float>& near,
                                      const CastOptions<float>& options, Observer&& observer) {
  const ShapeDefinition<double>& definition = *shape.definition().in_double();
  const auto placement = definition.placed({});
  const PreparedShape<double> exact(definition, placement.centre,
                                    placement.is_rigid_identity ? nullptr : &placement.to_inner);
  RayNearBall<double> exact_near = in_precision<double>(near);
  exact_near.s += shape.inner_ball().centre.cast<double>() - exact.centre();
  exact_near = exact_near.mapped(exact.linear_to_inner() ? *exact.linear_to_inner()
                                                         : Mat3<double>(Mat3<double>::Identity()));
  const auto tell = [&](const CastIteration<double>& iteration) {
    std::vector<Vec3<float>> simplex;
    for (const Vec3<double>& p : iteration.simplex) simplex.push_back(p.cast<float>());
    observer(CastIteration<float>{float(iteration.lambda), iteration.x.cast<float>(),
                                  iteration.v.cast<float>(), iteration.p.cast<float>(),
                                  iteration.w.cast<float>(), simplex});
  };
  CastResult<double> found;
  if constexpr (std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>)
    found = cast_near(exact, exact_near, in_double(options), NoObserver());
  else
    found = cast_near(exact, exact_near, in_double(options), tell);
  CastResult<float> result = in_precision<float>(found);
  result.t_base = near.t_base;
  result.path = Path::finer;
  return result;
}

/// Whether an answer is meant to be exact: coarser tolerances prove nothing.
template <class T>
bool is_exact(const CastOptions<T>& options) {
  return !is_reference(options.solver) && options.eps_tol <= tolerance::gjk_squared<T>;
}

template <class T, class Observer>
CastResult<T> cast_near(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                        const CastOptions<T>& options, Observer&& observer) {
  const bool is_extreme = shape.definition().is_extreme();
  // Results are built where they are returned: a processor reads slowly what was just written in
  // parts (docs/decisions/packets.md).
  const auto cast = [&] {
    if constexpr (std::is_same_v<T, float>)
      if (is_extreme && is_exact(options))
        return cast_through_double(shape, near, options, observer);
    return cast_inner(shape, near, options, observer);
  };
  CastResult<T> result = cast();
  if constexpr (std::is_same_v<T, double>) {
    const bool is_doubtful = result.status == Status::hit && !shape.definition().is_smooth() &&
                             -result.normal.dot(near.r) < tolerance::doubtful_slope<T>;
    if ((is_extreme || is_doubtful) && is_exact(options))
      result = prove_or_replace(shape, near, options, result, observer);
  }
  const bool is_default =
      options.solver == SolverKind::automatic || options.solver == SolverKind::jet;
  if (result.status == Status::exhausted && is_default && !is_extreme && is_exact(options))
    result = replace_exhausted(shape, near, result);
  result.normal = shape.normal_to_outer(result.normal);
  // A direction so short that the hit's t is no number of T.
  if (result.status == Status::hit && !std::isfinite(result.t())) result.status = Status::exhausted;
  // Where lengths in the shape's own frame overflow, or their squares vanish.
  const bool has_numbers = !std::isnan(result.t_base) && !std::isnan(result.t_offset) &&
                           !std::isnan(result.offset_lo) && !std::isnan(result.offset_hi);
  const bool no_plane = result.status == Status::miss && result.normal.isZero(T(0));
  if (!has_numbers || no_plane || !result.normal.allFinite()) {
    result.status = Status::exhausted;
    result.normal.setZero();
  }
  return result;
}

/// Whether bounds may be asked first: not by solvers that are meant to be as they were published,
/// and not where answers have to be proven.
template <class T>
bool asks_bounds(const PreparedShape<T>& shape, SolverKind solver) {
  if (shape.definition().is_extreme()) return false;
  if (solver == SolverKind::automatic) solver = best_solver(shape);
  return solver == SolverKind::jet || solver == SolverKind::portal;
}

/// A hit no earlier than the ray's beginning, which rounding may have put within the shape's
/// surface, and no later than its end.
template <class T>
void keep_result_on_ray(const Ray<T>& ray, CastResult<T>& result) {
  if (result.status != Status::hit) return;
  if (result.t() > ray.t_max) {  // by rounding
    const T last = ray.t_max - result.t_base;
    result.t_offset = last - std::numeric_limits<T>::epsilon() * std::abs(last);
  }
  result.t_offset = std::max(result.t_offset, -result.t_base);
  result.offset_lo = std::min(result.offset_lo, result.t_offset);
  result.offset_hi = std::max(result.offset_hi, result.t_offset);
}

/// The ray in the inner frame, with all its digits wherever it comes from.
template <class T>
RayNearBall<T> near_inner(const PreparedShape<T>& shape, const Ray<T>& ray) {
  RayNearBall<T> near = shape.to_inner(ray);
  if (near.is_from_afar(shape.inner_ball().radius) || shape.is_far_out())
    near = shape.to_inner_from_afar(ray);
  return near;
}

/// Exhausted, if the ray has lost its digits even so: but for misses by more than that.
template <class T>
void end_far_cast(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                  CastResult<T>& result) {
  const T R = shape.inner_ball().radius,
          error = std::abs(near.lambda_min) / tolerance::farthest_origin<T>;
  if (!(R > T(0)) || error <= R) return;
  const T nearest = std::min(std::max(T(0), near.lambda_min), near.lambda_max);
  const bool is_clear = (near.s + nearest * near.r).stableNorm() > R + T(4) * error;
  if (result.status == Status::miss && is_clear) return;
  CastResult<T> none;
  none.iterations = result.iterations;
  none.supports = result.supports;
  result = none;
}

template <class T>
CastResult<T> cast_past_bounds(const PreparedShape<T>& shape, const Ray<T>& ray,
                               const CastOptions<T>& options, const CastObserver<T>& observer) {
  const RayNearBall<T> near = near_inner(shape, ray);
  CastResult<T> result = observer ? cast_near(shape, near, options, observer)
                                  : cast_near(shape, near, options, NoObserver());
  end_far_cast(shape, near, result);
  keep_result_on_ray(ray, result);
  if (result.status == Status::inside)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = T(0);
  return result;
}

}  // namespace

template <class T>
CastResult<T> cast_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options, const CastObserver<T>& observer) {
  if (asks_bounds(shape, options.solver)) {
    const BoundsCast<T> bounds = cast_at_box(shape.line_to_inner(ray), shape.inner_half_extents(),
                                             shape.inner_ball().radius, true);
    if (bounds.miss) {
      const Vec3<T> normal = shape.normal_to_outer(bounds.normal);
      if (normal.squaredNorm() > T(0)) return miss_of(normal);
    }
  }
  return cast_past_bounds(shape, ray, options, observer);
}

template <class T>
CastResult<T> exit_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options) {
  const RayNearBall<T> near = near_inner(shape, ray);
  CastResult<T> result = cast_near(shape, near.reversed(), options, NoObserver());
  end_far_cast(shape, near, result);
  std::swap(result.offset_lo, result.offset_hi);
  keep_result_on_ray(ray, result);
  return result;
}

template CastResult<float> cast_by_later_stages(const PreparedShape<float>&, const Ray<float>&,
                                                const CastOptions<float>&,
                                                const CastObserver<float>&);
template CastResult<double> cast_by_later_stages(const PreparedShape<double>&, const Ray<double>&,
                                                 const CastOptions<double>&,
                                                 const CastObserver<double>&);
template CastResult<float> exit_by_later_stages(const PreparedShape<float>&, const Ray<float>&,
                                                const CastOptions<float>&);
template CastResult<double> exit_by_later_stages(const PreparedShape<double>&, const Ray<double>&,
                                                 const CastOptions<double>&);

}  // namespace minkray
