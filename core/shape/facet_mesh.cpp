// SPDX-License-Identifier: MIT
#include "core/shape/facet_mesh.h"

#include <algorithm>
#include <tuple>

namespace minkray {
namespace {

/// Along one side of the cube map's faces; finer ones would leave the cache and save no steps.
constexpr double finest_cube_map = 64;

}  // namespace

template <class T>
FacetMesh<T>::FacetMesh(const ConvexHull& hull, std::span<const Vec3<double>> vertices) {
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const std::span<const std::uint32_t> polygon = hull.facets[f];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      corners.push_back({polygon[0], polygon[i], polygon[i + 1]});
      const Vec3<double>&a = vertices[polygon[0]], &b = vertices[polygon[i]],
            &c = vertices[polygon[i + 1]];
      facets_.push_back({{a.cast<T>(), b.cast<T>(), c.cast<T>()},
                         unit<double>((b - a).cross(c - a)).template cast<T>(),
                         {0, 0, 0}});
    }
  }
  link_neighbours(corners);
  fill_cube_map();
}

template <class T>
void FacetMesh<T>::link_neighbours(std::span<const std::array<std::uint32_t, 3>> corners) {
  struct Edge {
    std::uint32_t low, high, facet, side;
    bool operator<(const Edge& o) const { return std::tie(low, high) < std::tie(o.low, o.high); }
  };
  std::vector<Edge> edges;
  edges.reserve(facets_.size() * 3);
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[f][k], b = corners[f][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), f, k});
      facets_[f].neighbours[k] = f;  // until its neighbour is found
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a < b) continue;
    facets_[a.facet].neighbours[a.side] = b.facet;
    facets_[b.facet].neighbours[b.side] = a.facet;
  }
}

template <class T>
void FacetMesh<T>::fill_cube_map() {
  resolution_ = static_cast<std::size_t>(std::clamp(
      std::ceil(std::sqrt(static_cast<double>(facets_.size()) / 6)), 1.0, finest_cube_map));
  const double width = 2.0 / static_cast<double>(resolution_);
  std::uint32_t at = 0;
  for (std::size_t cell = 0; cell < 6 * resolution_ * resolution_; ++cell) {
    const std::size_t face = cell / (resolution_ * resolution_);
    const int axis = static_cast<int>(face / 2);
    Vec3<T> direction;
    direction[axis] = face % 2 == 0 ? T(1) : T(-1);
    direction[(axis + 1) % 3] =
        static_cast<T>(-1 + width * (0.5 + static_cast<double>(cell / resolution_ % resolution_)));
    direction[(axis + 2) % 3] =
        static_cast<T>(-1 + width * (0.5 + static_cast<double>(cell % resolution_)));
    // Uphill from the last cell's.
    for (bool climbed = true; climbed;) {
      climbed = false;
      for (const std::uint32_t other : facets_[at].neighbours)
        if (facets_[other].normal.dot(direction) > facets_[at].normal.dot(direction))
          at = other, climbed = true;
    }
    facing_.push_back(at);
  }
}

template class FacetMesh<float>;
template class FacetMesh<double>;

}  // namespace minkray
