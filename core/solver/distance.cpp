// SPDX-License-Identifier: MIT
// Where the distance algorithm meets the shapes, in 3D and in the plane.
#include "core/solver/distance.h"

namespace minkray {
namespace {

/// The supports of a flat shape in the plane z = 0, which of any other are its shadow's.
template <class T, int Dim>
Vec<T, Dim> support_in(const Shape<T>& shape, const Vec<T, Dim>& v) {
  Vec3<T> direction = Vec3<T>::Zero();
  direction.template head<Dim>() = v;
  return shape.support(direction).template head<Dim>();
}

template <class T, int Dim>
DistanceResult<T, Dim> solve(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, Dim>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<T, Dim>&)>& observer) {
  const auto supports = [&](const Vec<T, Dim>& v) {
    return SupportPair<T, Dim>{support_in<T, Dim>(a.about_centre, v),
                               support_in<T, Dim>(b.about_centre, Vec<T, Dim>(-v))};
  };
  const Vec<T, Dim> x = (b.centre - a.centre).template head<Dim>();
  const T radius = a.radius + b.radius;
  DistanceResult<T, Dim> result =
      with_subalgorithm<T, Dim>(subalgorithm, [&]<class G>(G Y) -> DistanceResult<T, Dim> {
        if (observer) return gjk_distance<T, Dim>(supports, x, radius, options, Y, observer);
        return gjk_distance<T, Dim>(supports, x, radius, options, Y);
      });
  result.point_a += a.centre.template head<Dim>();
  result.point_b += a.centre.template head<Dim>();
  return result;
}

}  // namespace

template <class T>
DistanceResult<T, 3> distance_between(const CentredShape<T>& a, const CentredShape<T>& b,
                                      const DistanceOptions<T, 3>& options,
                                      SubalgorithmKind subalgorithm,
                                      const DistanceObserver<T>& observer) {
  return solve<T, 3>(a, b, options, subalgorithm, observer);
}

template <class T>
DistanceResult<T, 2> distance_in_plane(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, 2>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<T, 2>&)>& observer) {
  return solve<T, 2>(a, b, options, subalgorithm, observer);
}

#define MINKRAY_INSTANTIATE(T)                                                                   \
  template DistanceResult<T, 3> distance_between(const CentredShape<T>&, const CentredShape<T>&, \
                                                 const DistanceOptions<T, 3>&, SubalgorithmKind, \
                                                 const DistanceObserver<T>&);                    \
  template DistanceResult<T, 2> distance_in_plane(                                               \
      const CentredShape<T>&, const CentredShape<T>&, const DistanceOptions<T, 2>&,              \
      SubalgorithmKind, const std::function<void(const DistanceIteration<T, 2>&)>&);
MINKRAY_INSTANTIATE(float)
MINKRAY_INSTANTIATE(double)
#undef MINKRAY_INSTANTIATE

}  // namespace minkray
