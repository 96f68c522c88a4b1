// SPDX-License-Identifier: MIT
#include "core/geometry/point_cloud.h"

#include <cassert>

#include "core/geometry/convex_hull.h"

namespace minkray {
namespace {

/// From this many vertices on, the direction table (9 ns at any size that fits the cache) is
/// clearly faster than a scan of all of them (0.65 ns each; both in float on an AMD EPYC).
constexpr std::size_t table_from = 24;

/// A hull has twice as many facets as vertices, and walks keep the index of one in a float, which
/// holds whole numbers up to 2^24.
constexpr std::size_t most_vertices_with_facets = std::size_t(1) << 22;

}  // namespace

template <class T>
PointCloud<T>::PointCloud(std::vector<Vec3<T>> points, std::string source)
    : source_(std::move(source)) {
  assert(!points.empty());
  std::vector<Vec3<double>> exact;
  exact.reserve(points.size());
  for (const Vec3<T>& point : points) {
    assert(point.allFinite());
    exact.push_back(point.template cast<double>());
  }
  const ConvexHull hull = convex_hull(exact);
  auto extreme = std::make_shared<std::vector<Vec3<T>>>();
  extreme->reserve(hull.vertices.size());
  for (const std::uint32_t v : hull.vertices) extreme->push_back(points[v]);
  points_ = std::move(extreme);
  std::vector<Vec3<double>> vertices;
  vertices.reserve(hull.vertices.size());
  for (const std::uint32_t v : hull.vertices) vertices.push_back(exact[v]);
  if (vertices.size() >= table_from)
    table_ = std::make_shared<const DirectionTable>(hull, vertices);
  if (hull.rank() == 3 && vertices.size() <= most_vertices_with_facets)
    facets_ = with_supports(FacetMesh<T>(hull, vertices));
}

namespace {

/// The best of `size` indices. Compares by index: keeping the point itself would copy three
/// numbers wherever a maximum is beaten.
template <class T, class Index>
std::size_t furthest_of(const Vec3<T>* points, std::size_t size, Index&& index, const Vec3<T>& n) {
  std::size_t best = index(0);
  T furthest = n.dot(points[best]);
  for (std::size_t i = 1; i < size; ++i) {
    const T along = n.dot(points[index(i)]);
    best = along > furthest ? index(i) : best;
    furthest = along > furthest ? along : furthest;
  }
  return best;
}

}  // namespace

template <class T>
std::size_t PointCloud<T>::furthest(const Vec3<T>& n, T cell) const {
  const Vec3<T>* const points = points_->data();
  if (!table_)
    return furthest_of(
        points, points_->size(), [](std::size_t i) { return i; }, n);
  const std::span<const std::uint32_t> list = table_->candidates(static_cast<std::size_t>(cell));
  return furthest_of(
      points, list.size(), [&](std::size_t i) { return list[i]; }, n);
}

template <class T>
std::shared_ptr<const FacetMesh<T>> PointCloud<T>::with_supports(FacetMesh<T> facets) const {
  facets.find_supported([&](const Vec3<T>& n) { return support(n); });
  if (!facets.is_supported()) return nullptr;
  return std::make_shared<const FacetMesh<T>>(std::move(facets));
}

template class PointCloud<float>;
template class PointCloud<double>;
// For oracles.
template std::size_t PointCloud<long double>::furthest(const Vec3<long double>&, long double) const;
template std::shared_ptr<const FacetMesh<long double>> PointCloud<long double>::with_supports(
    FacetMesh<long double>) const;

}  // namespace minkray
