// SPDX-License-Identifier: MIT
// Later stages of a cast (solver.h): those after `filter` and `bounds`, one function each. Ray and
// result are in the shape's inner frame; each result has its `path` set.
#pragma once

#include "core/cast/cast.h"

namespace minkray {

/// Input of all stages. The observer, if any, receives every iteration.
struct StageQuestion {
  const PreparedShape& shape;
  const RayNearBall<double>& near;
  const CastOptions& options;
  const CastObserver& observer;
};

/// Runs Stage::operands, without an observer. Returns `exhausted` if the shape is no sum of two
/// operands, or if rounding leaves the result open.
CastResult<double> ask_operands(const StageQuestion& question);

/// Runs Stage::model or Stage::support_portal.
CastResult<double> ask_model(Stage stage, const StageQuestion& question);

/// Runs Stage::gjk or Stage::given.
CastResult<double> ask_gjk(Stage stage, const StageQuestion& question);

/// Runs Stage::finer, in long double. The result's t_base is near.t_base.
CastResult<double> ask_finer(const StageQuestion& question);

/// Same as ask_model and ask_gjk, but report every iteration to the observer. Compiled separately,
/// so that casts without an observer stay fast.
CastResult<double> ask_model_observed(Stage stage, const StageQuestion& question);
CastResult<double> ask_gjk_observed(Stage stage, const StageQuestion& question);

}  // namespace minkray
