// SPDX-License-Identifier: MIT
#include "core/geometry/facet_mesh.h"

#include <algorithm>
#include <tuple>

namespace minkray {
namespace {

/// Cells of the cube map per facet. With 4, a walk over a sphere's hull takes two facets on
/// average.
constexpr double cells_per_facet = 4;

/// Limit of cells. More cells would not fit in the cache, and would save no steps.
constexpr double most_cells = 6 * 64 * 64;

}  // namespace

FacetMesh::Facet::Facet(const std::array<Vec3<double>, 3>& counter_clockwise) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      numbers_[corners + 3 * k + axis] = counter_clockwise[k][static_cast<int>(axis)];
  find_normal();
}

void FacetMesh::Facet::find_normal() {
  const Vec3<double> a = corner(0), b = corner(1), c = corner(2);
  const Vec3<double> ab = b - a, bc = c - b, ac = c - a;
  const Vec3<double> normal =
      unit<double>(ab.squaredNorm() < bc.squaredNorm() ? ab.cross(ac) : ac.cross(bc));
  for (std::size_t axis = 0; axis < 3; ++axis)
    numbers_[normals + axis] = normal[static_cast<int>(axis)];
}

double FacetMesh::Facet::thickness() const {
  const Vec3<double> ab = corner(1) - corner(0), ac = corner(2) - corner(0),
                     bc = corner(2) - corner(1);
  const double longest =
      std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()}));
  return longest > 0.0 ? ab.cross(ac).norm() / longest : 0.0;
}

void FacetMesh::Facet::turn(std::size_t k) {
  const auto first = numbers_.begin();
  std::rotate(first, first + static_cast<std::ptrdiff_t>(3 * k), first + neighbours);
  std::rotate(first + neighbours, first + static_cast<std::ptrdiff_t>(neighbours + k),
              first + normals);
}

FacetMesh::FacetMesh(const ConvexHull& hull, std::span<const Vec3<double>> vertices) {
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const std::span<const std::uint32_t> polygon = hull.facets[f];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      corners.push_back({polygon[0], polygon[i], polygon[i + 1]});
      const Facet facet({vertices[polygon[0]], vertices[polygon[i]], vertices[polygon[i + 1]]});
      facets_.push_back(facet);
    }
  }
  link_neighbours(corners);
  fill_cube_map();
}

void FacetMesh::link_neighbours(std::span<const std::array<std::uint32_t, 3>> corners) {
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
      facets_[f].numbers_[Facet::neighbours + k] =
          static_cast<double>(f);  // replaced when the neighbour is found
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a < b) continue;
    facets_[a.facet].numbers_[Facet::neighbours + a.side] = static_cast<double>(b.facet);
    facets_[b.facet].numbers_[Facet::neighbours + b.side] = static_cast<double>(a.facet);
  }
}

void FacetMesh::fill_cube_map() {
  directions_ =
      CubeMap(std::min(cells_per_facet * static_cast<double>(facets_.size()), most_cells));
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  facing_.assign(directions_.cells(), none);
  const auto middle_of = [&](const CubeMap::Cell& square, double u, double v) {
    Vec3<double> direction;
    direction[square.axis] = square.sign;
    direction[(square.axis + 1) % 3] = square.u + u * square.width;
    direction[(square.axis + 2) % 3] = square.v + v * square.width;
    return direction;
  };
  const auto cell_of = [&](const Vec3<double>& direction) {
    return static_cast<std::size_t>(directions_.cell_of(direction));
  };
  // Fills cells, beginning with those that contain normals, and then their neighbours. In each
  // cell, climbs to the facet whose normal is nearest. From a distance, climbing alone would stop
  // on sides with several facets.
  std::vector<std::size_t> reached;
  const auto reach = [&](std::size_t cell, std::uint32_t facet) {
    if (facing_[cell] != none) return;
    facing_[cell] = facet;
    reached.push_back(cell);
  };
  const auto climb = [&](std::uint32_t at, const Vec3<double>& direction) {
    for (bool climbed = true; climbed;) {
      climbed = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t other = facets_[at].neighbour(k);
        if (facets_[other].normal().dot(direction) > facets_[at].normal().dot(direction))
          at = static_cast<std::uint32_t>(other), climbed = true;
      }
    }
    return at;
  };
  for (std::uint32_t f = 0; f < facets_.size(); ++f) reach(cell_of(facets_[f].normal()), f);
  for (std::size_t i = 0; i < reached.size(); ++i) {  // NOLINT(modernize-loop-convert): it grows
    const CubeMap::Cell square = directions_[reached[i]];
    std::uint32_t& facet = facing_[reached[i]];
    facet = climb(facet, middle_of(square, 0.5, 0.5));
    for (const auto& [u, v] : {std::pair{-0.5, 0.5}, {1.5, 0.5}, {0.5, -0.5}, {0.5, 1.5}})
      reach(cell_of(middle_of(square, u, v)), facet);
  }
}

}  // namespace minkray
