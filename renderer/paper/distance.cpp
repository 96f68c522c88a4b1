// SPDX-License-Identifier: MIT
// Applies the distance algorithm to shapes, in 3D and in the plane.
#include "renderer/paper/distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace minkray {
namespace {

/// Support point in 3D or, in 2D, of the shape's projection to the plane z = 0.
template <int Dim>
Vec<double, Dim> support_in(const Shape& shape, const Vec<double, Dim>& v) {
  Vec3<double> direction = Vec3<double>::Zero();
  direction.template head<Dim>() = v;
  return shape.support(direction).template head<Dim>();
}

/// Passes the iteration to the observer, with all lengths multiplied by `unit`.
template <int Dim>
void tell_in(double unit, const DistanceIteration<double, Dim>& iteration,
             const std::function<void(const DistanceIteration<double, Dim>&)>& observer) {
  const auto scaled = [unit](std::span<const Vec<double, Dim>> points) {
    std::vector<Vec<double, Dim>> all;
    for (const Vec<double, Dim>& point : points) all.push_back(unit * point);
    return all;
  };
  const std::vector<Vec<double, Dim>> before = scaled(iteration.before),
                                      after = scaled(iteration.after);
  observer({unit * iteration.v, unit * iteration.w, unit * iteration.v_next, unit * iteration.lower,
            unit * iteration.upper, before, after});
}

/// Returns a unit of length for which squares of lengths are in range. Scaling by it, a power of
/// two, is exact.
double unit_for(double largest) {
  constexpr double least = std::numeric_limits<double>::min();
  return largest < least ? least : leading_power_of_two(largest);
}

/// Computes in numbers of type F; the shapes' support points have type double.
template <class F, int Dim>
DistanceResult<double, Dim> solve(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, Dim>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<double, Dim>&)>& observer) {
  const Vec<double, Dim> apart = (b.centre - a.centre).template head<Dim>();
  const double largest = std::max(a.radius + b.radius, apart.cwiseAbs().maxCoeff());
  if (!std::isfinite(largest)) return {};
  const double unit = unit_for(largest);
  const auto supports = [&](const Vec<F, Dim>& v) {
    // Scales the direction to the range of double.
    const Vec<double, Dim> n =
        (std::is_same_v<F, double> ? v : Vec<F, Dim>(v / v.cwiseAbs().maxCoeff()))
            .template cast<double>();
    const Vec<double, Dim> p = support_in<Dim>(a.about_centre, n) / unit,
                           q = support_in<Dim>(b.about_centre, Vec<double, Dim>(-n)) / unit;
    return SupportPair<F, Dim>{p.template cast<F>(), q.template cast<F>()};
  };
  const Vec<F, Dim> x = (apart / unit).template cast<F>();
  const F radius = F((a.radius + b.radius) / unit);
  const DistanceOptions<F, Dim> same_options{F(options.gap), options.max_iterations,
                                             options.v0.template cast<F>(),
                                             options.only_separation};
  const DistanceResult<F, Dim> found =
      with_subalgorithm<F, Dim>(subalgorithm, [&]<class G>(G Y) -> DistanceResult<F, Dim> {
        if constexpr (std::is_same_v<F, double>) {
          const auto tell = [&](const DistanceIteration<double, Dim>& iteration) {
            tell_in(unit, iteration, observer);
          };
          if (observer) return gjk_distance<F, Dim>(supports, x, radius, same_options, Y, tell);
        }
        return gjk_distance<F, Dim>(supports, x, radius, same_options, Y);
      });
  const Vec<double, Dim> centre = a.centre.template head<Dim>();
  const auto placed = [&](const Vec<F, Dim>& p) -> Vec<double, Dim> {
    return p.template cast<double>() * unit + centre;
  };
  return {found.status,
          double(found.distance) * unit,
          double(found.lower) * unit,
          double(found.certificate) * unit * unit,
          placed(found.point_a),
          placed(found.point_b),
          found.axis.template cast<double>(),
          found.iterations,
          found.supports,
          found.backups};
}

/// True if rounding ended the loop before its two bounds met. This happens for curved surfaces near
/// each other, since their simplices are slivers.
bool is_coarse(const DistanceResult<double, 3>& result, double size) {
  if (result.status == DistanceStatus::overlapping) return false;
  const double rounding = tolerance::distance_gap<double> * (result.distance + size);
  return !(result.distance - result.lower <= 4.0 * rounding);
}

}  // namespace

DistanceResult<double, 3> distance_between(const CentredShape& a, const CentredShape& b,
                                           const DistanceOptions<double, 3>& options,
                                           SubalgorithmKind subalgorithm,
                                           const DistanceObserver& observer) {
  const DistanceResult<double, 3> result = solve<double, 3>(a, b, options, subalgorithm, observer);
  const bool was_free = result.iterations > 0 && result.iterations < options.max_iterations &&
                        !options.only_separation;
  if (!was_free || subalgorithm != SubalgorithmKind::projection ||
      !is_coarse(result, a.radius + b.radius))
    return result;
  // Runs again from this result, with more digits for the simplices but not for support points.
  DistanceOptions<double, 3> from_there = options;
  from_there.v0 = result.axis;
  DistanceResult<double, 3> finer = solve<long double, 3>(a, b, from_there, subalgorithm, {});
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

DistanceResult<double, 2> distance_in_plane(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, 2>& options,
    SubalgorithmKind subalgorithm,
    const std::function<void(const DistanceIteration<double, 2>&)>& observer) {
  return solve<double, 2>(a, b, options, subalgorithm, observer);
}

}  // namespace minkray
