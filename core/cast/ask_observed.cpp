// SPDX-License-Identifier: MIT
// Casts whose iterations are observed, for traces and pictures: not compiled for speed.
#include "core/cast/ask_gjk.h"
#include "core/cast/ask_model.h"

namespace minkray {

CastResult<double> ask_model_observed(Stage stage, const StageQuestion& question) {
  return cast_with_model(stage, question, question.observer);
}

CastResult<double> ask_gjk_observed(Stage stage, const StageQuestion& question) {
  return cast_with_gjk(stage, question, question.observer);
}

}  // namespace minkray
