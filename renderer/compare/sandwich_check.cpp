// SPDX-License-Identifier: MIT
#include "renderer/compare/sandwich_check.h"

#include <numeric>
#include <random>

namespace minkray {
namespace {

/// Rays in the sandwich's frame, in float so that Embree and the solver are given the same ones.
class RandomRays {
 public:
  RandomRays(const Sandwich& sandwich, std::uint64_t seed)
      : rank_(sandwich.rank()), centre_(sandwich.centre), random_(seed) {}

  /// From a sphere around the shape towards a point within `spread` of its centre (a segment's: of
  /// a point of the segment).
  Ray<float> next(double spread) {
    constexpr double start = 3;  // the shape lies within about 2 of its centre
    const Vec3<double> origin = centre_ + start * direction();
    Vec3<double> target = centre_ + spread * std::cbrt(uniform()) * direction();
    if (rank_ == 1) target.x() += uniform() - 0.5;
    const Vec3<double> towards = (target - origin).normalized();
    return {origin.cast<float>(), towards.cast<float>()};
  }

 private:
  // By hand: the standard's distributions differ between libraries, seeds must not.
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

Ray<double> from_frame(const RoundFrame& frame, const Ray<float>& ray) {
  const Vec3<double> direction = ray.direction.cast<double>().cwiseProduct(frame.extents);
  return {frame.from_frame(ray.origin.cast<double>()), frame.axes * direction};
}

class Judge {
 public:
  Judge(CompareReport& report, const EmbreeMesh& inner, const EmbreeMesh& outer)
      : report_(report), inner_(inner), outer_(outer) {}

  void see(const Ray<float>& mesh_ray, const Ray<double>& ray, const CastResult<double>& result) {
    const auto outer = outer_.cast(mesh_ray), inner = inner_.cast(mesh_ray);
    const bool hit = result.found();
    ++report_.rays;
    report_.hits += hit;
    report_.outer_hits += outer.has_value();
    report_.supports += result.supports;

    constexpr double infinity = std::numeric_limits<double>::infinity();
    Violator found{Violation::gave_up,
                   ray,
                   result.status,
                   result.t(),
                   outer ? outer->t : infinity,
                   inner ? inner->t : infinity,
                   infinity};
    const auto violates = [&](Violation kind) {
      ++report_.violations[static_cast<std::size_t>(kind)];
      found.kind = kind;
      if (!report_.worst || found.bounds > report_.worst->bounds) report_.worst = found;
    };
    if (result.status == Status::exhausted) return violates(Violation::gave_up);
    if (hit && !outer) {
      if (!outer_.is_met(mesh_ray)) return violates(Violation::false_hit);
      ++report_.embree_at_fault;
    }
    if (!hit && inner) {
      if (inner_.is_met(mesh_ray)) return violates(Violation::false_miss);
      ++report_.embree_at_fault;
    }
    if (!hit) return;

    const double t = result.t();
    // In units of the bound: 0/0 for a mesh met exactly edge-on, which nothing can be said about.
    const auto beyond = [](double excess, double bound) { return excess > 0 ? excess / bound : 0; };
    const double early = outer ? beyond(outer->t - t, outer->t_bound) : 0;
    const double late = inner ? beyond(t - inner->t, inner->t_bound) : 0;
    if (outer) report_.to_outer.add(t - outer->t);
    if (inner) report_.to_inner.add(inner->t - t);
    report_.worst_in_bounds = std::max({report_.worst_in_bounds, early, late});
    found.bounds = std::max(early, late);
    if (early > 1) return violates(Violation::early);
    if (late > 1) return violates(Violation::late);
  }

 private:
  CompareReport& report_;
  const EmbreeMesh& inner_;
  const EmbreeMesh& outer_;
};

}  // namespace

std::string_view name_of(Violation kind) {
  switch (kind) {
    case Violation::false_hit:
      return "false hit";
    case Violation::false_miss:
      return "false miss";
    case Violation::early:
      return "early";
    case Violation::late:
      return "late";
    case Violation::gave_up:
      return "gave up";
  }
  return "unknown";
}

int CompareReport::total_violations() const {
  return std::accumulate(violations.begin(), violations.end(), 0);
}

CompareReport compare_with_embree(const Shape<double>& shape, const CompareOptions& options) {
  const Sandwich sandwich = sandwich_of(shape, options.sandwich);
  const EmbreeMesh inner(sandwich.inner), outer(sandwich.outer);
  CompareReport report;
  report.rank = sandwich.rank();
  report.inner_triangles = sandwich.inner.triangles.size();
  report.outer_triangles = sandwich.outer.triangles.size();

  const double spread = spread_for_half(sandwich, outer, options.seed);
  const PreparedShape<double> prepared(shape);
  RandomRays rays(sandwich, options.seed);
  Judge judge(report, inner, outer);
  for (int i = 0; i < options.rays; ++i) {
    const Ray<float> mesh_ray = rays.next(spread);
    const Ray<double> ray = from_frame(sandwich.frame, mesh_ray);
    judge.see(mesh_ray, ray, cast_ray(prepared, ray, options.cast));
  }
  return report;
}

}  // namespace minkray
