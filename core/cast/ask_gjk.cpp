// SPDX-License-Identifier: MIT
#include "core/cast/ask_gjk.h"

#include "core/derived/convert.h"

namespace minkray {
namespace {

/// Mapped, though to itself: r is of unit length to the wider numbers' rounding then.
template <class Finer, class T>
RayNearBall<Finer> in_finer(const RayNearBall<T>& near) {
  return RayNearBall<Finer>{near.s.template cast<Finer>(),
                            near.r.template cast<Finer>(),
                            Finer(near.lambda_min),
                            Finer(near.lambda_max),
                            Finer(near.t_base),
                            Finer(near.t_shift),
                            Finer(near.t_per_length)}
      .mapped(Mat3<Finer>::Identity());
}

template <class Finer, class T>
CastResult<double> cast_finer(const Shape<Finer>& shape, const StageQuestion<T>& question) {
  const Ball<T>& ball = question.shape.inner_ball();
  const CastResult<Finer> found =
      gjk_ray_cast(shape, in_finer<Finer>(question.near),
                   Ball<Finer>{ball.centre.template cast<Finer>(), Finer(ball.radius)});
  return {found.status,
          Path::finer,
          double(found.t_base),
          double(found.t_offset),
          double(found.offset_lo),
          double(found.offset_hi),
          found.normal.template cast<double>(),
          found.iterations,
          found.supports};
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
