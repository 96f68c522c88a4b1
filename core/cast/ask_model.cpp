// SPDX-License-Identifier: MIT
#include "core/cast/ask_model.h"

namespace minkray {

CastResult<double> ask_model(Stage stage, const StageQuestion& question) {
  return question.observer ? ask_model_observed(stage, question)
                           : cast_with_model(stage, question, NoObserver());
}

}  // namespace minkray
