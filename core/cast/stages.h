// SPDX-License-Identifier: MIT
// Stages of a cast (policy.h) after the filter and the bounds, one function each, for a ray in the
// inner frame. Results have normals in that frame, and their `path`.
#pragma once

#include "core/cast/cast.h"
#include "core/cast/policy.h"

namespace minkray {

/// Input of all stages. The observer, if any, receives the iterations.
template <class T>
struct StageQuestion {
  const PreparedShape<T>& shape;
  const RayNearBall<T>& near;
  const CastOptions<T>& options;
  const CastObserver<T>& observer;
};

/// Stage::model, or Stage::support_portal.
template <class T>
CastResult<T> ask_model(Stage stage, const StageQuestion<T>& question);

/// Stage::gjk and the paper's other algorithms.
template <class T>
CastResult<T> ask_gjk(Stage stage, const StageQuestion<T>& question);

/// Stage::finer, in double or in long double. The result's t_base is near.t_base.
CastResult<double> ask_finer(const StageQuestion<float>& question);
CastResult<double> ask_finer(const StageQuestion<double>& question);

/// Same as the two above, with an observer; compiled separately, not used by casts.
template <class T>
CastResult<T> ask_model_observed(Stage stage, const StageQuestion<T>& question);
template <class T>
CastResult<T> ask_gjk_observed(Stage stage, const StageQuestion<T>& question);

extern template CastResult<float> ask_model(Stage, const StageQuestion<float>&);
extern template CastResult<double> ask_model(Stage, const StageQuestion<double>&);
extern template CastResult<float> ask_gjk(Stage, const StageQuestion<float>&);
extern template CastResult<double> ask_gjk(Stage, const StageQuestion<double>&);
extern template CastResult<float> ask_model_observed(Stage, const StageQuestion<float>&);
extern template CastResult<double> ask_model_observed(Stage, const StageQuestion<double>&);
extern template CastResult<float> ask_gjk_observed(Stage, const StageQuestion<float>&);
extern template CastResult<double> ask_gjk_observed(Stage, const StageQuestion<double>&);

}  // namespace minkray
