// SPDX-License-Identifier: MIT
// Runs the later stages of a cast in the order of the policy. First moves the ray's origin next to
// the shape; afterwards converts the result to the original ray.
#include "core/cast/later_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/cast/enclosed_ray.h"
#include "core/cast/judge.h"
#include "core/cast/within_loss.h"
#include "core/query/on_ray.h"

namespace minkray {
namespace {

ShapeKinds kind_of(const ShapeDefinition& definition) {
  if (definition.is_extreme()) return shape_kind::extreme;
  if (definition.form().kind != FormKind::none) return shape_kind::with_form;
  return definition.model() == ModelKind::osculating_sums ? shape_kind::osculated
                                                          : shape_kind::with_model;
}

/// True if the caller wants exact results. With coarser tolerances, results are not proven.
bool is_exact(const CastOptions& options) {
  return options.eps_tol <= tolerance::gjk_squared<double>;
}

bool has_stage(const PreparedShape& shape, const CastOptions& options, Stage stage) {
  const auto& stages = options.solver->policy_of(kind_of(shape.definition())).stages;
  return std::find(stages.begin(), stages.end(), stage) != stages.end();
}

/// Runs the policy's stages until the judge accepts a result.
CastResult<double> answer_of_stages(const StageQuestion& question) {
  const Policy& policy = question.options.solver->policy_of(kind_of(question.shape.definition()));
  const bool exact = is_exact(question.options);
  Judge judge(question, exact ? policy.proof : Proof::none);
  for (const Stage stage : policy.stages) {
    switch (stage) {
      case Stage::none:
        return judge.verdict();
      case Stage::filter:  // already run on the original ray
      case Stage::bounds:
        continue;
      case Stage::operands:
        if (question.observer) continue;
        if (judge.accepts(ask_operands(question))) return judge.verdict();
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

/// Runs the stages. The result's normal is in the inner frame.
CastResult<double> ask_stages(const StageQuestion& question) {
  CastResult<double> found = answer_of_stages(question);
  const bool is_checked = question.options.solver == &solver::automatic &&
                          is_exact(question.options) && found.status == Status::hit;
  if (is_checked && -found.normal.dot(question.near.r) < tolerance::bounded_slope<double>)
    found.offset_hi = std::numeric_limits<double>::infinity();
  return found;
}

/// Runs the stages. If the ray's position in the inner frame is uncertain, the result holds for all
/// rays within that uncertainty.
CastResult<double> ask_stages_about_place(const StageQuestion& question) {
  const PreparedShape& shape = question.shape;
  if (question.near.loss <= tolerance::small_loss<double> * shape.inner_ball().radius)
    return ask_stages(question);
  return ask_within_loss(shape, question.near, [&](const RayNearBall<double>& near) {
    CastResult<double> found =
        ask_stages(StageQuestion{shape, near, question.options, question.observer});
    if (found.status == Status::hit && std::isinf(found.offset_hi))
      enclose_ray(shape, near, found.normal, found);
    return found;
  });
}

/// Converts the result to the outer frame. Returns `exhausted` if its numbers would overflow.
CastResult<double> in_outer_frame(const PreparedShape& shape, CastResult<double> result) {
  result.normal = shape.normal_to_outer(result.normal);
  // If the direction is very short, the hit's t may overflow.
  if (result.status == Status::hit && !std::isfinite(result.t())) result.status = Status::exhausted;
  const bool no_plane = result.status == Status::miss && result.normal.isZero(0);
  if (no_plane || !has_numbers<double>(result, result.normal)) {
    result.status = Status::exhausted;
    result.normal.setZero();
  }
  return result;
}

/// Rescales a cast at a point, which has no size to which lengths could be scaled. Multiplies all
/// lengths by a power of two if the ray passes the point so closely that squares of lengths
/// underflow, but further away than the rounding of the point's position.
RayNearBall<double> with_squares(const PreparedShape& point, RayNearBall<double> near) {
  const double nearest = std::clamp(0.0, near.lambda_min, near.lambda_max);
  const Vec3<double> to_ray = near.s + nearest * near.r;
  const Mat3<double>* map = point.linear_to_inner();
  const double size = map ? map->cwiseAbs().maxCoeff() : 1.0;
  const double rounding =
      std::numeric_limits<double>::epsilon() * (point.centre().cwiseAbs().maxCoeff() * size);
  if (to_ray.squaredNorm() > 0.0 || !(to_ray.cwiseAbs().maxCoeff() > rounding)) return near;
  constexpr double up = 0x1p900;
  near.s *= up;
  near.lambda_min *= up;
  near.lambda_max *= up;
  near.t_per_length /= up;
  return near;
}

/// Maps the ray to the inner frame without losing digits, however far away its origin is.
RayNearBall<double> near_inner(const PreparedShape& shape, const Ray<double>& ray) {
  RayNearBall<double> near = shape.to_inner(ray);
  if (near.is_from_afar(shape.inner_ball().radius)) near = shape.to_inner_from_afar(ray);
  return shape.inner_ball().radius > 0.0 ? near : with_squares(shape, near);
}

/// Changes the result to `exhausted` if the ray's origin is so far away that rounding exceeds the
/// shape's size, except for misses by more than the rounding.
void end_far_cast(const PreparedShape& shape, const RayNearBall<double>& near,
                  CastResult<double>& result) {
  const double R = shape.inner_ball().radius,
               error = std::abs(near.lambda_min) / tolerance::farthest_origin;
  if (!(R > 0.0) || error <= R) return;
  const double nearest = std::min(std::max(0.0, near.lambda_min), near.lambda_max);
  const bool is_clear = std::hypot(near.s.stableNorm(), nearest) > R + 4.0 * error;
  if (result.status == Status::miss && is_clear) return;
  CastResult<double> none;
  none.iterations = result.iterations;
  none.supports = result.supports;
  result = none;
}

/// Adds an upper bound of t to a hit that has none. Does nothing for a solver chosen by name or a
/// coarse tolerance.
void bound_hit(const PreparedShape& shape, const RayNearBall<double>& near,
               const CastOptions& options, CastResult<double>& result) {
  if (result.status == Status::hit && std::isinf(result.offset_hi) && is_exact(options) &&
      options.solver == &solver::automatic)
    enclose_ray(shape, near, shape.normal_to_inner(result.normal), result);
}

/// Runs Stage::bounds, if the policy includes it: returns a miss if the ray misses the shape's
/// bounding box.
std::optional<CastResult<double>> ask_bounds(const PreparedShape& shape, const Ray<double>& ray,
                                             const CastOptions& options) {
  if (!has_stage(shape, options, Stage::bounds) || shape.definition().has_large_loss()) return {};
  const BoundsCast<double> bounds = cast_at_box(
      shape.line_to_inner(ray), shape.inner_half_extents(), shape.inner_ball().radius, true);
  if (!bounds.miss) return {};
  const Vec3<double> normal = shape.normal_to_outer(bounds.normal);
  if (!(normal.squaredNorm() > 0.0)) return {};
  return CastResult<double>{Status::miss, Path::model, 0.0, 0.0, 0.0, 0.0, normal, 0, 0};
}

}  // namespace

CastResult<double> cast_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options, const CastObserver& observer) {
  if (const auto miss = ask_bounds(shape, ray, options)) return *miss;
  const RayNearBall<double> near = near_inner(shape, ray);
  const StageQuestion question{shape, near, options, observer};
  CastResult<double> result = ask_stages_about_place(question);
  result = in_outer_frame(shape, result);
  end_far_cast(shape, near, result);
  if (result.status == Status::hit) keep_on_ray(ray, result);
  bound_hit(shape, near, options, result);
  if (result.status == Status::inside)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = 0.0;
  return result;
}

CastResult<double> exit_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options) {
  const RayNearBall<double> near = near_inner(shape, ray), back = near.reversed();
  const CastObserver nobody;
  const StageQuestion question{shape, back, options, nobody};
  CastResult<double> result = ask_stages_about_place(question);
  result = in_outer_frame(shape, result);
  end_far_cast(shape, near, result);
  bound_hit(shape, back, options, result);
  std::swap(result.offset_lo, result.offset_hi);
  if (result.status == Status::hit) keep_on_ray(ray, result);
  return result;
}

void bound_hit(const PreparedShape& shape, const Ray<double>& ray, CastResult<double>& result) {
  if (result.status == Status::hit && std::isinf(result.offset_hi))
    enclose_ray(shape, near_inner(shape, ray), shape.normal_to_inner(result.normal), result);
}

}  // namespace minkray
