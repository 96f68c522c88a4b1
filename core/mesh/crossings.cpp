// SPDX-License-Identifier: MIT
#include "core/mesh/crossings.h"

#include <algorithm>

#include "core/mesh/mesh_walk.h"
#include "core/mesh/perturbed_line.h"
#include "core/mesh/repeats.h"

namespace minkray {
namespace {

TriangleCorners corners_of(const TriangleMesh& mesh, std::uint32_t part) {
  return {mesh.corner(part, 0), mesh.corner(part, 1), mesh.corner(part, 2)};
}

/// True if the moved ray passes through the triangle.
bool is_passed(const TriangleMesh& mesh, const Ray<double>& ray, const PartHit& hit) {
  if (!hit.is_at_edge) return true;
  const TriangleCorners at = corners_of(mesh, hit.part);
  const int side = hit.is_back ? 1 : -1;
  for (std::size_t k = 0; k < 3; ++k)
    if (moved_side_of_edge(ray.origin, ray.direction, at[k], at[(k + 1) % 3]) != side) return false;
  return true;
}

/// Order of two hits along the ray: -1, 1, or 0 if they lie in one plane.
int order_of(const TriangleMesh& mesh, const Ray<double>& ray, const PartHit& a, const PartHit& b) {
  if (a.t + a.error < b.t - b.error) return -1;
  if (b.t + b.error < a.t - a.error) return 1;
  return order_along(ray, corners_of(mesh, a.part), corners_of(mesh, b.part));
}

/// The triangles that the moved ray passes, by t: all up to ray.t_max, and all beyond it that may
/// come before one of these. Repeated triangles count once.
std::vector<PartHit> passed_parts(const TriangleMesh& mesh, const Ray<double>& ray) {
  Ray<double> further = ray;
  further.t_max = ray.t_max * (1 + 0x1p-40);
  std::vector<PartHit> hits;
  for (double error = 0;;) {
    hits.clear();
    PartCounts counts;
    visit_hits(mesh, further, counts, [&](const PartHit& hit) {
      if (!is_passed(mesh, ray, hit)) return;
      if (hit.t <= ray.t_max) error = std::max(error, hit.error);
      hits.push_back(hit);
    });
    if (ray.t_max + error <= further.t_max) break;
    further.t_max = ray.t_max + 2 * error;
  }
  std::ranges::sort(hits, [](const PartHit& a, const PartHit& b) { return b.yields_to(a); });
  erase_repeats(mesh, hits);
  return hits;
}

/// Sorts hits that are sorted by t. Only neighbours within their errors change places. Returns true
/// if some lie in one plane; these are sorted by number.
bool sort_exactly(const TriangleMesh& mesh, const Ray<double>& ray, std::vector<PartHit>& hits) {
  bool has_same_plane = false;
  for (std::size_t i = 1; i < hits.size(); ++i)
    for (std::size_t k = i; k > 0; --k) {
      const int order = order_of(mesh, ray, hits[k - 1], hits[k]);
      has_same_plane |= order == 0;
      if (order < 0 || (order == 0 && hits[k - 1].part < hits[k].part)) break;
      std::swap(hits[k - 1], hits[k]);
    }
  return has_same_plane;
}

/// Returns how often the mesh winds around the ray's origin. Each later entry counts one less.
/// Requires all hits up to t = infinity.
int turns_at_begin(const std::vector<PartHit>& hits) {
  int turns = 0;
  for (const PartHit& hit : hits) turns += hit.is_back ? 1 : -1;
  return turns;
}

/// Sorts hits in one plane so that the ray is inside as rarely as possible.
void alternate(const TriangleMesh& mesh, const Ray<double>& ray, std::vector<PartHit>& hits,
               int turns) {
  for (std::size_t from = 0; from < hits.size(); ++from) {
    std::size_t to = from + 1;
    while (to < hits.size() && order_of(mesh, ray, hits[from], hits[to]) == 0) ++to;
    const bool leaves = turns > 0;
    const auto next = std::find_if(hits.begin() + static_cast<std::ptrdiff_t>(from),
                                   hits.begin() + static_cast<std::ptrdiff_t>(to),
                                   [&](const PartHit& hit) { return hit.is_back == leaves; });
    if (next != hits.begin() + static_cast<std::ptrdiff_t>(to))
      std::rotate(hits.begin() + static_cast<std::ptrdiff_t>(from), next, next + 1);
    turns += hits[from].is_back ? -1 : 1;
  }
}

}  // namespace

std::vector<PartHit> crossings(const TriangleMesh& mesh, const Ray<double>& ray) {
  std::vector<PartHit> hits = passed_parts(mesh, ray);
  if (sort_exactly(mesh, ray, hits)) {
    int turns = 0;
    if (mesh.is_closed()) {
      Ray<double> endless = ray;
      endless.t_max = std::numeric_limits<double>::infinity();
      turns = turns_at_begin(passed_parts(mesh, endless));
    }
    alternate(mesh, ray, hits, turns);
  }
  // The true t do not decrease, so each is at least the lower bounds before it.
  for (std::size_t i = 1; i < hits.size(); ++i) {
    PartHit& hit = hits[i];
    if (hit.t >= hits[i - 1].t) continue;
    hit.error += hits[i - 1].t - hit.t;
    hit.t = hits[i - 1].t;
  }
  std::erase_if(hits, [&](const PartHit& hit) { return !(hit.t <= ray.t_max); });
  return hits;
}

}  // namespace minkray
