// SPDX-License-Identifier: MIT
#include "core/geometry/point_cloud.h"

#include <algorithm>
#include <cassert>

#include "core/geometry/convex_hull.h"

namespace minkray {
namespace {

/// Least number of vertices for a direction table. A lookup takes 9 ns for any table in the cache;
/// a scan takes 0.65 ns per vertex (both in float on an AMD EPYC).
constexpr std::size_t table_from = 24;

/// Limit for hulls with facets. A hull has twice as many facets as vertices, and walks store a
/// facet's index in a float, which is exact up to 2^24.
constexpr std::size_t most_vertices_with_facets = std::size_t(1) << 22;

}  // namespace

PointCloud::PointCloud(std::vector<Vec3<double>> points, std::string source)
    : source_(std::move(source)) {
  assert(!points.empty());
  assert(std::ranges::all_of(points, [](const Vec3<double>& p) { return p.allFinite(); }));
  const ConvexHull hull = convex_hull(points);
  auto extreme = std::make_shared<std::vector<Vec3<double>>>();
  extreme->reserve(hull.vertices.size());
  for (const std::uint32_t v : hull.vertices) extreme->push_back(points[v]);
  points_ = std::move(extreme);
  const std::vector<Vec3<double>>& vertices = *points_;
  if (vertices.size() >= table_from)
    table_ = std::make_shared<const DirectionTable>(hull, vertices);
  if (hull.rank() < 3 || vertices.size() > most_vertices_with_facets) return;
  FacetMesh facets(hull, vertices);
  facets.find_supported([&](const Vec3<double>& n) { return support(n); });
  if (facets.is_supported()) facets_ = std::make_shared<const FacetMesh>(std::move(facets));
}

namespace {

/// Returns the best of `size` indices. Compares by index, since copying a point for each new
/// maximum would take longer.
template <class W, class Index>
std::size_t furthest_of(const Vec3<double>* points, std::size_t size, Index&& index,
                        const Vec3<W>& n) {
  const auto reach = [&](std::size_t i) { return n.dot(widen<W>(points[i])); };
  std::size_t best = index(0);
  W furthest = reach(best);
  for (std::size_t i = 1; i < size; ++i) {
    const W along = reach(index(i));
    best = along > furthest ? index(i) : best;
    furthest = along > furthest ? along : furthest;
  }
  return best;
}

}  // namespace

template <std::floating_point W>
std::size_t PointCloud::furthest(const Vec3<W>& n, W cell) const {
  const Vec3<double>* const points = points_->data();
  if (!table_)
    return furthest_of(
        points, points_->size(), [](std::size_t i) { return i; }, n);
  const std::span<const std::uint32_t> list = table_->candidates(static_cast<std::size_t>(cell));
  return furthest_of(
      points, list.size(), [&](std::size_t i) { return list[i]; }, n);
}

template std::size_t PointCloud::furthest(const Vec3<double>&, double) const;
template std::size_t PointCloud::furthest(const Vec3<long double>&, long double) const;

}  // namespace minkray
