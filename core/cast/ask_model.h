// SPDX-License-Identifier: MIT
// Runs the stage of a cast (solver.h) that uses models (core/model), for an observer of any type.
#pragma once

#include "core/cast/stages.h"
#include "core/model/model_of.h"

namespace minkray {

/// Returns `exhausted` if the model does not converge, or if rounding leaves open whether the
/// origin lies inside.
template <class Observer>
CastResult<double> cast_with_model(Stage stage, const StageQuestion& question,
                                   Observer&& observer) {
  const PreparedShape& shape = question.shape;
  const RayNearBall<double>& near = question.near;
  const Ball<double>& ball = shape.inner_ball();
  BoundsCast<double> bounds{true, false, Vec3<double>::Zero()};
  cast_at_ball(near, ball.radius, bounds);
  CastResult<double> result;
  if (bounds.miss) {
    result.status = Status::miss;
    result.normal = bounds.normal;
    result.offset_hi = 0.0;
    return result;
  }
  if (!bounds.open) return result;
  const bool is_portal = stage == Stage::support_portal;
  const int max_iterations =
      is_portal ? tolerance::portal_max_iterations : tolerance::jet_max_iterations;
  const auto cast = [&](const auto& make_model) {
    CastLanes<double> lanes = model_cast<double>(make_model, near, ball, shape.inner_half_extents(),
                                                 true, max_iterations, observer);
    // A hit on the portal's triangle alone proves nothing about a curved shape.
    if (is_portal && lanes.by_model) lanes.hit = false;
    if (lanes.uncertain && shape.definition().uncertain_slope() > 0.0) lanes.inside = false;
    return result_of(lanes);
  };
  if (!is_portal) return with_model<double>(shape.definition(), cast);
  return cast([&](const Vec3<double>& s, const Vec3<double>& r) {
    return PolytopeModel<double, Shape>(shape.inner_shape(), ball.centre, s, r, ball.radius);
  });
}

}  // namespace minkray
