// SPDX-License-Identifier: MIT
// Connects the distance algorithm to the shapes, in 3D and in the plane.
#include "core/shape_cast/distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace minkray {
namespace {

/// The supports of a flat shape in the plane z = 0, which of any other are its shadow's.
template <class T, int Dim>
Vec<T, Dim> support_in(const Shape<T>& shape, const Vec<T, Dim>& v) {
  Vec3<T> direction = Vec3<T>::Zero();
  direction.template head<Dim>() = v;
  return shape.support(direction).template head<Dim>();
}

/// Passes the iteration to the observer, with lengths in another unit.
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

/// Computes in numbers of type F; the shapes' supports are of type T.
template <class F, class T, int Dim>
DistanceResult<T, Dim> solve(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, Dim>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<T, Dim>&)>& observer) {
  const Vec<T, Dim> apart = (b.centre - a.centre).template head<Dim>();
  const T largest = std::max(a.radius + b.radius, apart.cwiseAbs().maxCoeff());
  if (!std::isfinite(largest)) return {};
  const T unit = unit_for(largest);
  const auto supports = [&](const Vec<F, Dim>& v) {
    // A direction of T's range.
    const Vec<T, Dim> n =
        (std::is_same_v<F, T> ? v : Vec<F, Dim>(v / v.cwiseAbs().maxCoeff())).template cast<T>();
    const Vec<T, Dim> p = support_in<T, Dim>(a.about_centre, n) / unit,
                      q = support_in<T, Dim>(b.about_centre, Vec<T, Dim>(-n)) / unit;
    return SupportPair<F, Dim>{p.template cast<F>(), q.template cast<F>()};
  };
  const Vec<F, Dim> x = (apart / unit).template cast<F>();
  const F radius = F((a.radius + b.radius) / unit);
  const DistanceOptions<F, Dim> same_options{F(options.gap), options.max_iterations,
                                             options.v0.template cast<F>(),
                                             options.only_separation};
  const DistanceResult<F, Dim> found =
      with_subalgorithm<F, Dim>(subalgorithm, [&]<class G>(G Y) -> DistanceResult<F, Dim> {
        if constexpr (std::is_same_v<F, T>) {
          const auto tell = [&](const DistanceIteration<T, Dim>& iteration) {
            tell_in(unit, iteration, observer);
          };
          if (observer) return gjk_distance<F, Dim>(supports, x, radius, same_options, Y, tell);
        }
        return gjk_distance<F, Dim>(supports, x, radius, same_options, Y);
      });
  const Vec<T, Dim> centre = a.centre.template head<Dim>();
  const auto placed = [&](const Vec<F, Dim>& p) -> Vec<T, Dim> {
    return p.template cast<T>() * unit + centre;
  };
  return {found.status,
          T(found.distance) * unit,
          T(found.lower) * unit,
          T(found.certificate) * unit * unit,
          placed(found.point_a),
          placed(found.point_b),
          found.axis.template cast<T>(),
          found.iterations,
          found.supports,
          found.backups};
}

/// True if rounding ended the loop before its two bounds met: curved surfaces near each other make
/// simplices that are slivers.
template <class T>
bool is_coarse(const DistanceResult<T, 3>& result, T size) {
  if (result.status == DistanceStatus::overlapping) return false;
  const T rounding = tolerance::distance_gap<T> * (result.distance + size);
  return !(result.distance - result.lower <= T(4) * rounding);
}

}  // namespace

template <class T>
DistanceResult<T, 3> distance_between(const CentredShape<T>& a, const CentredShape<T>& b,
                                      const DistanceOptions<T, 3>& options,
                                      SubalgorithmKind subalgorithm,
                                      const DistanceObserver<T>& observer) {
  const DistanceResult<T, 3> result = solve<T, T, 3>(a, b, options, subalgorithm, observer);
  const bool was_free = result.iterations > 0 && result.iterations < options.max_iterations &&
                        !options.only_separation;
  if (!was_free || subalgorithm != SubalgorithmKind::projection ||
      !is_coarse(result, a.radius + b.radius))
    return result;
  // Once more from its answer, with the supports as they are, but more digits for their simplices.
  using Finer = std::conditional_t<std::is_same_v<T, float>, double, long double>;
  DistanceOptions<T, 3> from_there = options;
  from_there.v0 = result.axis;
  DistanceResult<T, 3> finer = solve<Finer, T, 3>(a, b, from_there, subalgorithm, {});
  const bool is_possible =
      finer.status == DistanceStatus::separated ||
      (finer.status == DistanceStatus::overlapping && result.status == DistanceStatus::exhausted);
  const bool is_better =
      is_possible && finer.distance - finer.lower < result.distance - result.lower;
  if (!is_better) return result;
  finer.iterations += result.iterations;
  finer.supports += result.supports;
  return finer;
}

template <class T>
DistanceResult<T, 2> distance_in_plane(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, 2>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<T, 2>&)>& observer) {
  return solve<T, T, 2>(a, b, options, subalgorithm, observer);
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
