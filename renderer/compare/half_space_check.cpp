// SPDX-License-Identifier: MIT
#include "renderer/compare/half_space_check.h"

#include <cmath>
#include <random>

namespace minkray {
namespace {

using Number = long double;

/// Doublings of t until the ray is below the plane, and halvings from there.
constexpr int most_doublings = 200, most_halvings = 100;

/// Error bound of heights at double numbers, in units of their epsilon times the summands.
constexpr Number rounding = 8 * Number(std::numeric_limits<double>::epsilon());

}  // namespace

Verdict HalfSpaceCheck::judge(const Ray<double>& ray) const {
  const auto height = [&](Number t) {
    Number sum = -Number(half_space_.offset);
    for (int axis = 0; axis < 3; ++axis)
      sum += Number(half_space_.normal[axis]) *
             (Number(ray.origin[axis]) + t * Number(ray.direction[axis]));
    return sum;
  };
  const auto slack = [&](Number t) {
    Number sum = std::abs(Number(half_space_.offset));
    for (int axis = 0; axis < 3; ++axis)
      sum += std::abs(Number(half_space_.normal[axis])) *
             (std::abs(Number(ray.origin[axis])) + t * std::abs(Number(ray.direction[axis])));
    return rounding * sum;
  };
  Verdict verdict;
  verdict.result = cast_ray(half_space_, ray);
  const bool found = verdict.result.found();
  // First a t at which the ray is below the plane, if there is one.
  const Number end =
      std::isfinite(ray.t_max) ? Number(ray.t_max) : std::ldexp(Number(1), most_doublings);
  Number above = 0, below = std::min<Number>(1, end);
  if (height(0) <= 0) {
    verdict.t_outer = verdict.t_inner = 0;
    if (verdict.result.status != Status::inside && height(0) < -slack(0))
      verdict.violation = Violation::false_miss;
    return verdict;
  }
  while (below < end && height(below) > 0) {
    above = below;
    below = std::min(2 * below, end);
  }
  if (height(below) > 0) {
    if (found && height(Number(verdict.result.t())) > slack(Number(verdict.result.t())))
      verdict.violation = Violation::false_hit;
    return verdict;
  }
  for (int i = 0; i < most_halvings; ++i) {
    const Number middle = (above + below) / 2;
    (height(middle) > 0 ? above : below) = middle;
  }
  verdict.t_outer = static_cast<double>(above);
  verdict.t_inner = static_cast<double>(below);
  if (!found) {
    if (height(end) < -slack(end)) verdict.violation = Violation::false_miss;
    return verdict;
  }
  const Number t = Number(verdict.result.t());
  verdict.bounds = static_cast<double>(std::abs(height(t)) / slack(t));
  if (verdict.bounds > 1) verdict.violation = t < above ? Violation::early : Violation::late;
  return verdict;
}

CompareReport HalfSpaceCheck::compare(const CompareOptions& options) const {
  CompareReport report;
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return unit<double>({normal(random), normal(random), normal(random)});
  };
  for (int i = 0; i < options.rays; ++i) {
    Vec3<double> origin = half_space_.offset * half_space_.normal + 10.0 * direction();
    const double depth = half_space_.normal.dot(origin) - half_space_.offset;
    if (depth < 0) origin -= 2 * depth * half_space_.normal;
    const Ray<double> ray{origin, direction()};
    const Verdict verdict = judge(ray);
    ++report.rays;
    report.hits += verdict.result.found() ? 1 : 0;
    report.outer_hits += std::isfinite(verdict.t_outer) ? 1 : 0;
    report.worst_in_bounds = std::max(report.worst_in_bounds, verdict.bounds);
    if (!verdict.violation) continue;
    ++report.violations[static_cast<std::size_t>(*verdict.violation)];
    if (!report.worst)
      report.worst = Violator{*verdict.violation,    ray,
                              verdict.result.status, verdict.result.t(),
                              verdict.t_outer,       verdict.t_inner,
                              verdict.bounds};
  }
  return report;
}

}  // namespace minkray
