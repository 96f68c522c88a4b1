// SPDX-License-Identifier: MIT
// Runs a policy's stages in a loop: moves the ray near the shape first, and converts the result to
// the original ray afterwards.
#include "core/cast/later_stages.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/cast/enclosed_ray.h"
#include "core/cast/in_double.h"
#include "core/cast/judge.h"
#include "core/cast/within_loss.h"
#include "core/query/on_ray.h"

namespace minkray {
namespace {

template <class T>
ShapeKinds kind_of(const ShapeDefinition<T>& definition) {
  if (definition.is_extreme()) return shape_kind::extreme;
  if (definition.is_lost_in_rounding()) return shape_kind::lost;
  if (definition.form().kind != FormKind::none) return shape_kind::with_form;
  return definition.model() == ModelKind::osculating_sums ? shape_kind::osculated
                                                          : shape_kind::with_model;
}

/// True if the result is meant to be exact: coarser tolerances prove nothing.
template <class T>
bool is_exact(const CastOptions<T>& options) {
  return options.eps_tol <= tolerance::gjk_squared<T>;
}

template <class T>
bool has_stage(const PreparedShape<T>& shape, const CastOptions<T>& options, Stage stage) {
  const auto& stages = policy_of(options.solver, kind_of(shape.definition())).stages;
  return std::find(stages.begin(), stages.end(), stage) != stages.end();
}

/// Runs stages until the judge accepts a result. The normal is in the inner frame.
template <class T>
CastResult<T> ask_stages(const StageQuestion<T>& question) {
  const Policy& policy = policy_of(question.options.solver, kind_of(question.shape.definition()));
  const bool exact = is_exact(question.options);
  Judge<T> judge(question, exact ? policy.proof : Proof::none);
  for (const Stage stage : policy.stages) {
    switch (stage) {
      case Stage::none:
        return judge.verdict();
      case Stage::filter:  // already run on the original ray
      case Stage::in_double:
      case Stage::bounds:
        continue;
      case Stage::model:
      case Stage::support_portal:
        if (judge.accepts(ask_model(stage, question))) return judge.verdict();
        continue;
      case Stage::finer:
        if (!exact) continue;
        if (judge.accepts_finer(ask_finer(question))) return judge.verdict();
        judge.try_once_more();
        continue;
      default:
        if (judge.accepts(ask_gjk(stage, question))) return judge.verdict();
    }
  }
  return judge.verdict();
}

/// Runs the stages for all rays within the ray's uncertainty.
template <class T>
CastResult<T> ask_stages_about_place(const StageQuestion<T>& question) {
  const PreparedShape<T>& shape = question.shape;
  if (question.near.loss <= tolerance::small_loss<T> * shape.inner_ball().radius)
    return ask_stages(question);
  return ask_within_loss(shape, question.near, [&](const RayNearBall<T>& near) {
    CastResult<T> found =
        ask_stages(StageQuestion<T>{shape, near, question.options, question.observer});
    if constexpr (std::is_same_v<T, double>)
      if (found.status == Status::hit && std::isinf(found.offset_hi))
        enclose_ray(shape, near, found.normal, found);
    return found;
  });
}

/// Converts the result to the outer frame; exhausted if it exceeds the range of numbers.
template <class T>
CastResult<T> in_outer_frame(const PreparedShape<T>& shape, CastResult<T> result) {
  result.normal = shape.normal_to_outer(result.normal);
  // The direction is so short that the hit's t exceeds the range of T.
  if (result.status == Status::hit && !std::isfinite(result.t())) result.status = Status::exhausted;
  const bool no_plane = result.status == Status::miss && result.normal.isZero(T(0));
  if (no_plane || !has_numbers<T>(result, result.normal)) {
    result.status = Status::exhausted;
    result.normal.setZero();
  }
  return result;
}

/// A point has no scale of its own: if the ray passes it so closely that squares of lengths
/// underflow, but further away than its position's rounding, all lengths are multiplied by a power
/// of two.
template <class T>
RayNearBall<T> with_squares(const PreparedShape<T>& point, RayNearBall<T> near) {
  const T nearest = std::clamp(T(0), near.lambda_min, near.lambda_max);
  const Vec3<T> to_ray = near.s + nearest * near.r;
  const Mat3<T>* map = point.linear_to_inner();
  const T size = map ? map->cwiseAbs().maxCoeff() : T(1);
  const T rounding =
      std::numeric_limits<T>::epsilon() * (point.centre().cwiseAbs().maxCoeff() * size);
  if (to_ray.squaredNorm() > T(0) || !(to_ray.cwiseAbs().maxCoeff() > rounding)) return near;
  constexpr T up = std::is_same_v<T, float> ? T(0x1p100) : T(0x1p900);
  near.s *= up;
  near.lambda_min *= up;
  near.lambda_max *= up;
  near.t_per_length /= up;
  return near;
}

/// Maps the ray to the inner frame without losing digits, however distant its origin.
template <class T>
RayNearBall<T> near_inner(const PreparedShape<T>& shape, const Ray<T>& ray) {
  RayNearBall<T> near = shape.to_inner(ray);
  if (near.is_from_afar(shape.inner_ball().radius) || shape.is_far_out())
    near = shape.to_inner_from_afar(ray);
  return shape.inner_ball().radius > T(0) ? near : with_squares(shape, near);
}

/// Returns `exhausted` if the ray has lost its digits even so, except for misses by more than the
/// loss.
template <class T>
void end_far_cast(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                  CastResult<T>& result) {
  const T R = shape.inner_ball().radius,
          error = std::abs(near.lambda_min) / tolerance::farthest_origin<T>;
  if (!(R > T(0)) || error <= R) return;
  const T nearest = std::min(std::max(T(0), near.lambda_min), near.lambda_max);
  const bool is_clear = std::hypot(near.s.stableNorm(), nearest) > R + T(4) * error;
  if (result.status == Status::miss && is_clear) return;
  CastResult<T> none;
  none.iterations = result.iterations;
  none.supports = result.supports;
  result = none;
}

/// Adds an upper bound to a hit without one. Skips solvers chosen by name and coarse tolerances.
template <class T>
void bound_hit(const PreparedShape<T>& shape, const RayNearBall<T>& near,
               const CastOptions<T>& options, CastResult<T>& result) {
  if constexpr (std::is_same_v<T, double>)
    if (result.status == Status::hit && std::isinf(result.offset_hi) && is_exact(options) &&
        options.solver == SolverKind::automatic)
      enclose_ray(shape, near, shape.normal_to_inner(result.normal), result);
}

/// A miss found by the shape's box, if the policy includes that stage.
template <class T>
std::optional<CastResult<T>> ask_bounds(const PreparedShape<T>& shape, const Ray<T>& ray,
                                        const CastOptions<T>& options) {
  if (!has_stage(shape, options, Stage::bounds) || shape.definition().has_large_loss()) return {};
  const BoundsCast<T> bounds = cast_at_box(shape.line_to_inner(ray), shape.inner_half_extents(),
                                           shape.inner_ball().radius, true);
  if (!bounds.miss) return {};
  const Vec3<T> normal = shape.normal_to_outer(bounds.normal);
  if (!(normal.squaredNorm() > T(0))) return {};
  return CastResult<T>{Status::miss, Path::model, T(0), T(0), T(0), T(0), normal, 0, 0};
}

/// True if the policy includes a cast in double; rays in double are so already.
template <class T>
bool asks_in_double(const PreparedShape<T>& shape, const CastOptions<T>& options) {
  return std::is_same_v<T, float> && is_exact(options) &&
         has_stage(shape, options, Stage::in_double) && shape.definition().is_asked_in_double();
}

CastResult<float> cast_in_double(const PreparedShape<float>& shape, const Ray<float>& ray,
                                 const CastOptions<float>& options,
                                 const CastObserver<float>& observer) {
  const auto cast = [&](const PreparedShape<double>& same, const Ray<double>& same_ray,
                        const CastOptions<double>& same_options) {
    return cast_ray(same, same_ray, same_options, in_double(observer));
  };
  return ask_in_double(shape, ray, options, cast);
}

/// True if a hit's plane is so steep that rounding along the ray is large: the cast is then
/// repeated in double instead of proven.
template <class T>
bool is_steep_in_float(const StageQuestion<T>& question, const CastResult<T>& answer) {
  const ShapeDefinition<T>& definition = question.shape.definition();
  return std::is_same_v<T, float> && answer.status == Status::hit &&
         -answer.normal.dot(question.near.r) < definition.uncertain_slope() &&
         policy_of(question.options.solver, kind_of(definition)).proof == Proof::steep_hits &&
         is_exact(question.options) && definition.in_double();
}

}  // namespace

template <class T>
CastResult<T> cast_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options, const CastObserver<T>& observer) {
  if constexpr (std::is_same_v<T, float>)
    if (asks_in_double(shape, options)) return cast_in_double(shape, ray, options, observer);
  if (const auto miss = ask_bounds(shape, ray, options)) return *miss;
  const RayNearBall<T> near = near_inner(shape, ray);
  const StageQuestion<T> question{shape, near, options, observer};
  CastResult<T> result = ask_stages_about_place(question);
  if constexpr (std::is_same_v<T, float>)
    if (is_steep_in_float(question, result)) return cast_in_double(shape, ray, options, observer);
  result = in_outer_frame(shape, result);
  end_far_cast(shape, near, result);
  if (result.status == Status::hit) keep_on_ray(ray, result);
  bound_hit(shape, near, options, result);
  if (result.status == Status::inside)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = T(0);
  return result;
}

template <class T>
CastResult<T> exit_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options) {
  if constexpr (std::is_same_v<T, float>)
    if (asks_in_double(shape, options))
      return ask_in_double(shape, ray, options, cast_exit<double>);
  const RayNearBall<T> near = near_inner(shape, ray), back = near.reversed();
  const CastObserver<T> nobody;
  const StageQuestion<T> question{shape, back, options, nobody};
  CastResult<T> result = ask_stages_about_place(question);
  if constexpr (std::is_same_v<T, float>)
    if (is_steep_in_float(question, result))
      return ask_in_double(shape, ray, options, cast_exit<double>);
  result = in_outer_frame(shape, result);
  end_far_cast(shape, near, result);
  bound_hit(shape, back, options, result);
  std::swap(result.offset_lo, result.offset_hi);
  if (result.status == Status::hit) keep_on_ray(ray, result);
  return result;
}

void bound_hit(const PreparedShape<double>& shape, const Ray<double>& ray,
               CastResult<double>& result) {
  if (result.status == Status::hit && std::isinf(result.offset_hi))
    enclose_ray(shape, near_inner(shape, ray), shape.normal_to_inner(result.normal), result);
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
