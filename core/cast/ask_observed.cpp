// SPDX-License-Identifier: MIT
// Casts whose iterations are observed, for traces and pictures: not compiled for speed.
#include "core/cast/ask_gjk.h"
#include "core/cast/ask_model.h"

namespace minkray {

template <class T>
CastResult<T> ask_model_observed(Stage stage, const StageQuestion<T>& question) {
  return cast_with_model(stage, question, question.observer);
}

template <class T>
CastResult<T> ask_gjk_observed(Stage stage, const StageQuestion<T>& question) {
  return cast_with_gjk(stage, question, question.observer);
}

template CastResult<float> ask_model_observed(Stage, const StageQuestion<float>&);
template CastResult<double> ask_model_observed(Stage, const StageQuestion<double>&);
template CastResult<float> ask_gjk_observed(Stage, const StageQuestion<float>&);
template CastResult<double> ask_gjk_observed(Stage, const StageQuestion<double>&);

}  // namespace minkray
