// SPDX-License-Identifier: MIT
// Where the distance algorithm meets the shapes, in 3D and in the plane.
#include "core/solver/distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/shape/convert.h"

namespace minkray {
namespace {

/// The supports of a flat shape in the plane z = 0, which of any other are its shadow's.
template <class T, int Dim>
Vec<T, Dim> support_in(const Shape<T>& shape, const Vec<T, Dim>& v) {
  Vec3<T> direction = Vec3<T>::Zero();
  direction.template head<Dim>() = v;
  return shape.support(direction).template head<Dim>();
}

/// The same iteration, of lengths in another unit.
template <class T, int Dim>
void tell_in(T unit, const DistanceIteration<T, Dim>& iteration,
             const std::function<void(const DistanceIteration<T, Dim>&)>& observer) {
  const auto scaled = [unit](std::span<const Vec<T, Dim>> points) {
    std::vector<Vec<T, Dim>> all;
    for (const Vec<T, Dim>& point : points) all.push_back(unit * point);
    return all;
  };
  const std::vector<Vec<T, Dim>> before = scaled(iteration.before), after = scaled(iteration.after);
  observer({unit * iteration.v, unit * iteration.w, unit * iteration.v_next, unit * iteration.lower,
            unit * iteration.upper, before, after});
}

/// A unit in which squares of lengths are numbers: a power of two, which rounds nothing.
template <class T>
T unit_for(T largest) {
  constexpr T least = std::numeric_limits<T>::min();
  return largest < least ? least : leading_power_of_two(largest);
}

template <class T, int Dim>
DistanceResult<T, Dim> solve(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, Dim>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<T, Dim>&)>& observer) {
  const Vec<T, Dim> apart = (b.centre - a.centre).template head<Dim>();
  const T largest = std::max(a.radius + b.radius, apart.cwiseAbs().maxCoeff());
  if (!std::isfinite(largest)) return {};
  const T unit = unit_for(largest);
  const auto supports = [&](const Vec<T, Dim>& v) {
    return SupportPair<T, Dim>{support_in<T, Dim>(a.about_centre, v) / unit,
                               support_in<T, Dim>(b.about_centre, Vec<T, Dim>(-v)) / unit};
  };
  const Vec<T, Dim> x = apart / unit;
  const T radius = (a.radius + b.radius) / unit;
  const auto tell = [&](const DistanceIteration<T, Dim>& iteration) {
    tell_in(unit, iteration, observer);
  };
  DistanceResult<T, Dim> result =
      with_subalgorithm<T, Dim>(subalgorithm, [&]<class G>(G Y) -> DistanceResult<T, Dim> {
        if (observer) return gjk_distance<T, Dim>(supports, x, radius, options, Y, tell);
        return gjk_distance<T, Dim>(supports, x, radius, options, Y);
      });
  result.distance *= unit;
  result.lower *= unit;
  result.certificate = result.certificate * unit * unit;
  const Vec<T, Dim> centre = a.centre.template head<Dim>();
  result.point_a = result.point_a * unit + centre;
  result.point_b = result.point_b * unit + centre;
  return result;
}

/// With more digits, where rounding left the solver without an answer.
template <class T>
DistanceResult<T, 3> solve_finer(const CentredShape<T>& a, const CentredShape<T>& b,
                                 const DistanceOptions<T, 3>& options) {
  using Finer = std::conditional_t<std::is_same_v<T, float>, double, long double>;
  const auto finer = [](const CentredShape<T>& shape) {
    return CentredShape<Finer>{convert<Finer>(shape.about_centre),
                               shape.centre.template cast<Finer>(), Finer(shape.radius)};
  };
  DistanceOptions<Finer, 3> finer_options;
  finer_options.gap = options.gap;
  finer_options.max_iterations = options.max_iterations;
  finer_options.v0 = options.v0.template cast<Finer>();
  const DistanceResult<Finer, 3> found =
      solve<Finer, 3>(finer(a), finer(b), finer_options, SubalgorithmKind::projection, {});
  return {found.status,
          T(found.distance),
          T(found.lower),
          T(found.certificate),
          found.point_a.template cast<T>(),
          found.point_b.template cast<T>(),
          found.axis.template cast<T>(),
          found.iterations,
          found.supports,
          found.backups};
}

}  // namespace

template <class T>
DistanceResult<T, 3> distance_between(const CentredShape<T>& a, const CentredShape<T>& b,
                                      const DistanceOptions<T, 3>& options,
                                      SubalgorithmKind subalgorithm,
                                      const DistanceObserver<T>& observer) {
  const DistanceResult<T, 3> result = solve<T, 3>(a, b, options, subalgorithm, observer);
  const bool gave_up = result.status == DistanceStatus::exhausted &&
                       result.iterations < options.max_iterations && result.iterations > 0;
  if (!gave_up || subalgorithm != SubalgorithmKind::projection || options.only_separation)
    return result;
  DistanceResult<T, 3> finer = solve_finer(a, b, options);
  if (finer.status == DistanceStatus::exhausted) return result;
  finer.iterations += result.iterations;
  finer.supports += result.supports;
  finer.backups += result.backups;
  return finer;
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
