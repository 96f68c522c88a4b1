// SPDX-License-Identifier: MIT
#include "renderer/paper/solvers.h"

#include "core/gjk/gjk_ray_cast.h"
#include "core/shape/shape.h"
#include "renderer/paper/first_solution.h"
#include "renderer/paper/johnson.h"
#include "renderer/paper/signed_volumes.h"

namespace minkray::paper {
namespace {

/// Returns cast(observer), without an observer if the given one is empty.
template <class Cast>
CastResult<double> observed(const CastObserver& observer, const Cast& cast) {
  return observer ? cast(observer) : cast(NoObserver());
}

}  // namespace

CastResult<double> cast_by_algorithm_1(const Shape& shape, const RayNearBall<double>& near,
                                       const Ball<double>& ball, const GjkCastOptions<double>&,
                                       const CastObserver& observer) {
  return observed(observer, [&](const auto& tell) {
    return first_solution(shape, near, ball, tolerance::first_solution_max_supports, tell);
  });
}

CastResult<double> cast_by_johnson(const Shape& shape, const RayNearBall<double>& near,
                                   const Ball<double>& ball, const GjkCastOptions<double>& options,
                                   const CastObserver& observer) {
  return observed(observer, [&](const auto& tell) {
    return gjk_ray_cast(shape, near, ball, options, tell, JohnsonSubalgorithm<double, 3>());
  });
}

CastResult<double> cast_by_signed_volumes(const Shape& shape, const RayNearBall<double>& near,
                                          const Ball<double>& ball,
                                          const GjkCastOptions<double>& options,
                                          const CastObserver& observer) {
  return observed(observer, [&](const auto& tell) {
    return gjk_ray_cast(shape, near, ball, options, tell, SignedVolumesSubalgorithm<double, 3>());
  });
}

}  // namespace minkray::paper
