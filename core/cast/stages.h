// SPDX-License-Identifier: MIT
// Stages of a cast (policy.h) after the filter and the bounds, one function each, for a ray in the
// inner frame. Results have normals in that frame, and their `path`.
#pragma once

#include "core/cast/cast.h"
#include "core/cast/policy.h"

namespace minkray {

/// Input of all stages. The observer, if any, receives the iterations.
struct StageQuestion {
  const PreparedShape& shape;
  const RayNearBall<double>& near;
  const CastOptions& options;
  const CastObserver& observer;
};

/// Stage::model, or Stage::support_portal.
CastResult<double> ask_model(Stage stage, const StageQuestion& question);

/// Stage::gjk and the paper's other algorithms.
CastResult<double> ask_gjk(Stage stage, const StageQuestion& question);

/// Stage::finer, in long double. The result's t_base is near.t_base.
CastResult<double> ask_finer(const StageQuestion& question);

/// Same as the two above, with an observer; compiled separately, not used by casts.
CastResult<double> ask_model_observed(Stage stage, const StageQuestion& question);
CastResult<double> ask_gjk_observed(Stage stage, const StageQuestion& question);

}  // namespace minkray
