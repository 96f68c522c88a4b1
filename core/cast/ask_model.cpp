// SPDX-License-Identifier: MIT
#include "core/cast/ask_model.h"

namespace minkray {

template <class T>
CastResult<T> ask_model(Stage stage, const StageQuestion<T>& question) {
  return question.observer ? ask_model_observed(stage, question)
                           : cast_with_model(stage, question, NoObserver());
}

template CastResult<float> ask_model(Stage, const StageQuestion<float>&);
template CastResult<double> ask_model(Stage, const StageQuestion<double>&);

}  // namespace minkray
