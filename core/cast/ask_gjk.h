// SPDX-License-Identifier: MIT
// Runs the stages of a cast (solver.h) that use support points alone, for an observer of any type.
#pragma once

#include "core/cast/stages.h"
#include "core/gjk/gjk_ray_cast.h"

namespace minkray {

/// Observed casts are compiled only for the type Shape: code for every kind of shape would not be
/// worthwhile.
template <class Observer>
CastResult<double> cast_with_gjk(Stage stage, const StageQuestion& question, Observer&& observer) {
  const auto& near = question.near;
  const CastOptions& options = question.options;
  const Shape& any = question.shape.inner_shape();
  const Ball<double>& ball = question.shape.inner_ball();
  GjkCastOptions<double> gjk{options.eps_tol, options.max_iterations, options.v0};
  if (!gjk.v0.isZero(0)) gjk.v0 = question.shape.normal_to_inner(gjk.v0);
  const auto answer = [&] {
    if (stage == Stage::given)
      return options.solver->given(any, near, ball, gjk, question.observer);
    if constexpr (std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>)
      return std::visit(
          [&](const auto& kind) { return gjk_ray_cast(kind, near, ball, gjk, observer); },
          any.kind);
    else
      return gjk_ray_cast(any, near, ball, gjk, observer);
  };
  CastResult<double> result = answer();
  result.path = Path::gjk;
  if (result.status == Status::hit) {  // known up to the rounding of a plane's offset
    const double slope = std::max(-result.normal.dot(near.r), tolerance::least_slope<double>);
    const double rounding =
        (tolerance::plane_rounding<double> * ball.radius + near.loss) / slope * near.t_per_length;
    // For reversed rays t decreases along the ray.
    const double digits = std::copysign(near.offset_rounding(result.t_offset), near.t_per_length);
    result.offset_lo -= rounding + digits;
    result.offset_hi += rounding + digits;
  }
  return result;
}

}  // namespace minkray
