// SPDX-License-Identifier: MIT
#include "renderer/compare/mesh_check.h"

#include <cmath>
#include <random>

namespace minkray {
namespace {

/// The mesh about the point, its vertices rounded to float.
Mesh rounded_about(const PosedMesh& posed, const Vec3<double>& centre) {
  Mesh mesh;
  for (const Vec3<double>& vertex : posed.mesh->vertices())
    mesh.vertices.push_back((posed.pose(vertex) - centre).cast<float>().cast<double>());
  mesh.triangles.assign(posed.mesh->triangles().begin(), posed.mesh->triangles().end());
  return mesh;
}

PosedMesh posed(const Mesh& mesh) {
  return {0, std::make_shared<const TriangleMesh>(mesh.vertices, mesh.triangles), {}};
}

}  // namespace

MeshCheck::MeshCheck(const PosedMesh& in_world)
    : bounds_(in_world.bounds()),
      centre_(bounds_.centre()),
      radius_(bounds_.half_extents().norm()),
      rounded_(posed(rounded_about(in_world, centre_))),
      embree_(rounded_about(in_world, centre_)) {}

Verdict MeshCheck::judge(const Ray<float>& ray) const {
  const Ray<double> same{ray.origin.cast<double>(), ray.direction.cast<double>(),
                         static_cast<double>(ray.t_max)};
  Verdict verdict;
  PartCounts parts;
  verdict.result = cast_ray(rounded_, same, same.t_max, false, 0, parts).cast;
  const std::optional<MeshHit> other = embree_.cast(ray);
  const bool is_found = verdict.result.found();
  const double t = verdict.result.t();
  if (other) {
    verdict.t_outer = other->t - other->t_bound;
    verdict.t_inner = other->t + other->t_bound;
  }
  if (is_found && !other) verdict.violation = Violation::false_hit;
  if (!is_found && other) verdict.violation = Violation::false_miss;
  if (is_found && other) {
    verdict.bounds = std::abs(t - other->t) / other->t_bound;
    if (t < verdict.t_outer) verdict.violation = Violation::early;
    if (t > verdict.t_inner) verdict.violation = Violation::late;
  }
  if (verdict.result.status == Status::exhausted) verdict.violation = Violation::gave_up;
  if (!verdict.violation) return verdict;
  // Each triangle in double, whose edges are off by rounding: at the interval of our own hit.
  const std::optional<double> judged = embree_.nearest(ray);
  constexpr double rounding = 1e-9;
  const bool agrees =
      judged ? is_found && std::abs(*judged - t) <= rounding * (1 + *judged) : !is_found;
  if (agrees) {
    verdict.violation.reset();
    verdict.embree_at_fault = true;
  }
  return verdict;
}

RayInFrame MeshCheck::to_frame(const Ray<double>& ray) const {
  RayInFrame in_frame;
  const double length = ray.direction.norm();
  const Vec3<double> along = ray.direction / length;
  const Vec3<double> from = ray.origin - centre_;
  // From two radii before the place nearest to the centre, if it begins further away.
  const double nearest = -from.dot(along);
  const double skipped = std::max(0.0, nearest - 2 * radius_);
  in_frame.ray.origin = (from + skipped * along).cast<float>();
  in_frame.ray.direction = along.cast<float>();
  in_frame.ray.t_max = std::numeric_limits<float>::infinity();
  in_frame.t_base = skipped / length;
  in_frame.t_per_length = 1 / length;
  return in_frame;
}

CompareReport MeshCheck::compare(const CompareOptions& options) const {
  CompareReport report;
  report.inner_triangles = report.outer_triangles = rounded_.mesh->size();
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto direction = [&] {
    return unit<double>({normal(random), normal(random), normal(random)});
  };
  const TriangleMesh& mesh = *rounded_.mesh;
  const auto aim = [&](int kind) -> Vec3<double> {
    const auto triangle =
        static_cast<std::uint32_t>(uniform(random) * static_cast<double>(mesh.size()));
    const Vec3<double>&a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1),
          &c = mesh.corner(triangle, 2);
    const double s = uniform(random), r = std::sqrt(uniform(random));
    if (kind == 0) return (1 - r) * a + r * ((1 - s) * b + s * c);
    if (kind == 1) return (1 - s) * a + s * b;
    if (kind == 2) return a;
    return 1.2 * radius_ * uniform(random) * direction();
  };
  for (int i = 0; i < options.rays; ++i) {
    Ray<float> ray;
    ray.origin = (radius_ * (1.5 + uniform(random)) * direction()).cast<float>();
    ray.direction = unit<double>(aim(i % 4) - ray.origin.cast<double>()).cast<float>();
    ray.t_max = std::numeric_limits<float>::infinity();
    const Verdict verdict = judge(ray);
    ++report.rays;
    report.hits += verdict.result.found() ? 1 : 0;
    report.outer_hits += std::isfinite(verdict.t_outer) ? 1 : 0;
    report.embree_at_fault += verdict.embree_at_fault ? 1 : 0;
    if (!verdict.embree_at_fault)
      report.worst_in_bounds = std::max(report.worst_in_bounds, verdict.bounds);
    if (!verdict.violation) continue;
    ++report.violations[static_cast<std::size_t>(*verdict.violation)];
    if (!report.worst)
      report.worst =
          Violator{*verdict.violation,    {ray.origin.cast<double>(), ray.direction.cast<double>()},
                   verdict.result.status, verdict.result.t(),
                   verdict.t_outer,       verdict.t_inner,
                   verdict.bounds};
  }
  return report;
}

}  // namespace minkray
