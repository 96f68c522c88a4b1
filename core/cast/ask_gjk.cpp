// SPDX-License-Identifier: MIT
#include "core/cast/ask_gjk.h"

#include "core/cast/in_precision.h"
#include "core/derived/convert.h"

namespace minkray {
namespace {

template <class Finer, class T>
CastResult<double> cast_finer(const Shape<Finer>& shape, const StageQuestion<T>& question) {
  // Mapped by the identity, which makes r a unit vector to the wider type's rounding.
  const RayNearBall<Finer> near =
      in_precision<Finer>(question.near).mapped(Mat3<Finer>::Identity());
  return in_precision<double>(
      gjk_ray_cast(shape, near, in_precision<Finer>(question.shape.inner_ball())));
}

}  // namespace

template <class T>
CastResult<T> ask_gjk(Stage stage, const StageQuestion<T>& question) {
  return question.observer ? ask_gjk_observed(stage, question)
                           : cast_with_gjk(stage, question, NoObserver());
}

CastResult<double> ask_finer(const StageQuestion<float>& question) {
  return cast_finer(convert<double>(question.shape.inner_shape()), question);
}

CastResult<double> ask_finer(const StageQuestion<double>& question) {
  if (const Shape<long double>* shape = question.shape.definition().in_long_double())
    return cast_finer(*shape, question);
  return cast_finer(convert<long double>(question.shape.inner_shape()), question);
}

template CastResult<float> ask_gjk(Stage, const StageQuestion<float>&);
template CastResult<double> ask_gjk(Stage, const StageQuestion<double>&);

}  // namespace minkray
