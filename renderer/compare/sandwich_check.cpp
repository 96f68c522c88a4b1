// SPDX-License-Identifier: MIT
#include "renderer/compare/sandwich_check.h"

#include <numeric>
#include <random>

namespace minkray {
namespace {

/// Rays start so far away, in the frame: the shape lies within about 2 of its centre.
constexpr double start_distance = 3;

/// Rays in the sandwich's frame, in float so that Embree and the solver are given the same ones.
class RandomRays {
 public:
  RandomRays(const Sandwich& sandwich, std::uint64_t seed)
      : rank_(sandwich.rank()), centre_(sandwich.centre), random_(seed) {}

  /// Next ray, from a sphere around the shape towards a point within `spread` of its centre (for a
  /// segment, of a point on it).
  Ray<float> next(double spread) {
    const Vec3<double> origin = centre_ + start_distance * direction();
    Vec3<double> target = centre_ + spread * std::cbrt(uniform()) * direction();
    if (rank_ == 1) target.x() += uniform() - 0.5;
    const Vec3<double> towards = (target - origin).normalized();
    return {origin.cast<float>(), towards.cast<float>()};
  }

 private:
  // Written here since the standard's distributions differ between libraries, and seeds must not.
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  Vec3<double> direction() {
    for (;;) {
      const Vec3<double> d(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
      if (const double squared = d.squaredNorm(); squared <= 1 && squared > 0.01)
        return d / std::sqrt(squared);
    }
  }

  int rank_;
  Vec3<double> centre_;
  std::mt19937_64 random_;
};

/// The spread with which half of the rays hit the mesh: bisection over its logarithm.
double spread_for_half(const Sandwich& sandwich, const EmbreeMesh& mesh, std::uint64_t seed) {
  constexpr int pilot_rays = 400, steps = 20;
  double low = std::log(1e-8), high = std::log(2.5);
  for (int step = 0; step < steps; ++step) {
    const double middle = (low + high) / 2;
    RandomRays rays(sandwich, seed);
    int hits = 0;
    for (int i = 0; i < pilot_rays; ++i) hits += mesh.cast(rays.next(std::exp(middle))).has_value();
    (2 * hits > pilot_rays ? low : high) = middle;
  }
  return std::exp(low);
}

void record(CompareReport& report, const Verdict& verdict, const Ray<double>& ray) {
  const CastResult<double>& result = verdict.result;
  const bool outer_hit = std::isfinite(verdict.t_outer), inner_hit = std::isfinite(verdict.t_inner);
  ++report.rays;
  report.hits += result.found();
  report.outer_hits += outer_hit;
  report.supports += result.supports;
  report.embree_at_fault += verdict.embree_at_fault;
  if (result.found() && outer_hit) {
    report.to_outer.add(result.t() - verdict.t_outer);
    report.worst_in_bounds = std::max(report.worst_in_bounds, verdict.bounds);
  }
  if (result.found() && inner_hit) report.to_inner.add(verdict.t_inner - result.t());
  if (!verdict.violation) return;
  ++report.violations[static_cast<std::size_t>(*verdict.violation)];
  if (!report.worst || verdict.bounds > report.worst->bounds)
    report.worst =
        Violator{*verdict.violation, ray,           result.status, result.t(), verdict.t_outer,
                 verdict.t_inner,    verdict.bounds};
}

}  // namespace

std::string_view name_of(Violation kind) {
  return name_at({"false hit", "false miss", "early", "late", "gave up"}, kind);
}

int CompareReport::total_violations() const {
  return std::accumulate(violations.begin(), violations.end(), 0);
}

SandwichedShape::SandwichedShape(const Shape& shape, const SandwichOptions& options)
    : prepared_(shape),
      sandwich_(sandwich_of(shape, options)),
      inner_(sandwich_.inner),
      outer_(sandwich_.outer) {}

Ray<double> SandwichedShape::to_shape(const Ray<float>& ray) const {
  const RoundFrame& frame = sandwich_.frame;
  const Vec3<double> direction = ray.direction.cast<double>().cwiseProduct(frame.extents);
  return {frame.from_frame(ray.origin.cast<double>()), frame.axes * direction,
          static_cast<double>(ray.t_max)};
}

RayInFrame SandwichedShape::to_frame(const Ray<double>& ray) const {
  const RoundFrame& frame = sandwich_.frame;
  const Vec3<double> origin = frame.to_frame(ray.origin);
  const Vec3<double> direction =
      (frame.axes.transpose() * ray.direction).cwiseQuotient(frame.extents);
  const double length = direction.norm();
  const Vec3<double> r = direction / length;
  const double start = std::max(0.0, (sandwich_.centre - origin).dot(r) - start_distance);
  return {{(origin + start * r).cast<float>(), r.cast<float>()}, start / length, 1 / length};
}

Verdict SandwichedShape::judge(const Ray<float>& ray, const CastOptions& options) const {
  Verdict verdict;
  verdict.result = cast_ray(prepared_, to_shape(ray), options);
  const auto outer = outer_.cast(ray), inner = inner_.cast(ray);
  if (outer) verdict.t_outer = outer->t;
  if (inner) verdict.t_inner = inner->t;
  const auto violates = [&](Violation kind, double bounds) {
    verdict.violation = kind;
    verdict.bounds = bounds;
    return verdict;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool hit = verdict.result.found();
  if (verdict.result.status == Status::exhausted) return violates(Violation::gave_up, infinity);
  if (hit && !outer) {
    if (!outer_.nearest(ray)) return violates(Violation::false_hit, infinity);
    verdict.embree_at_fault = true;
  }
  if (!hit && inner) {
    if (inner_.nearest(ray)) return violates(Violation::false_miss, infinity);
    verdict.embree_at_fault = true;
  }
  if (!hit) return verdict;

  const double t = verdict.result.t();
  const auto beyond = [](double excess, double bound) { return excess > 0 ? excess / bound : 0; };
  const double early = outer ? beyond(outer->t - t, outer->t_bound) : 0;
  const double late = inner ? beyond(t - inner->t, inner->t_bound) : 0;
  verdict.bounds = std::max(early, late);
  if (early > 1) {
    const auto referee = outer_.nearest(ray);
    if (!referee || *referee - t > outer->t_bound) return violates(Violation::early, early);
    verdict.embree_at_fault = true;
    verdict.bounds = beyond(*referee - t, outer->t_bound);
  }
  if (late > 1) {
    const auto referee = inner_.nearest(ray);
    if (referee && t - *referee > inner->t_bound) return violates(Violation::late, late);
    verdict.embree_at_fault = true;
    verdict.bounds = referee ? beyond(t - *referee, inner->t_bound) : 0;
  }
  return verdict;
}

CompareReport SandwichedShape::compare(const CompareOptions& options) const {
  CompareReport report;
  report.rank = sandwich_.rank();
  report.inner_triangles = sandwich_.inner.triangles.size();
  report.outer_triangles = sandwich_.outer.triangles.size();
  const double spread = spread_for_half(sandwich_, outer_, options.seed);
  RandomRays rays(sandwich_, options.seed);
  for (int i = 0; i < options.rays; ++i) {
    const Ray<float> ray = rays.next(spread);
    record(report, judge(ray, options.cast), to_shape(ray));
  }
  return report;
}

CompareReport compare_with_embree(const Shape& shape, const CompareOptions& options) {
  return SandwichedShape(shape, options.sandwich).compare(options);
}

}  // namespace minkray
