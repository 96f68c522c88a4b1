// SPDX-License-Identifier: MIT
#include "core/cast/ask_gjk.h"

#include "core/cast/in_precision.h"

namespace minkray {

CastResult<double> ask_gjk(Stage stage, const StageQuestion& question) {
  return question.observer ? ask_gjk_observed(stage, question)
                           : cast_with_gjk(stage, question, NoObserver());
}

CastResult<double> ask_finer(const StageQuestion& question) {
  using Finer = long double;
  // Mapping by the identity normalises r in the wider type.
  const RayNearBall<Finer> near =
      in_precision<Finer>(question.near).mapped(Mat3<Finer>::Identity());
  return in_precision<double>(gjk_ray_cast(question.shape.inner_shape(), near,
                                           in_precision<Finer>(question.shape.inner_ball())));
}

}  // namespace minkray
