// SPDX-License-Identifier: MIT
#include "core/geometry/direction_table.h"

#include <algorithm>
#include <array>
#include <utility>

namespace minkray {
namespace {

/// Cells per vertex. More cells make the lists shorter and the table larger. With 4, the lists of a
/// hull of 4096 points on an ellipsoid have 2.5 vertices on average, and the table takes 5 times
/// the points' memory.
constexpr double cells_per_vertex = 4;

/// Width by which cells and cones are widened, relative to the cube map's half width 1. Float finds
/// a direction's cell only up to a few roundings, and Qhull finds a vertex' neighbours only up to a
/// few roundings of double.
constexpr double widening = 16 * std::numeric_limits<float>::epsilon();

/// Lists for each vertex the vertices at the other end of its edges, one list after the other.
Polygons neighbours_of(const ConvexHull& hull) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(hull.facets.corners.size() * 2);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  Polygons neighbours;
  std::vector<std::uint32_t> others;
  auto edge = edges.begin();
  for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
    others.clear();
    for (; edge != edges.end() && edge->first == v; ++edge) others.push_back(edge->second);
    neighbours.add(others);
  }
  return neighbours;
}

struct Square {
  int axis;
  double sign;
  std::array<Eigen::Vector2d, 4> corners;  ///< the two components after `axis`, cyclically

  Vec3<double> direction(const Eigen::Vector2d& at) const {
    Vec3<double> m;
    m[axis] = sign;
    m[(axis + 1) % 3] = at.x();
    m[(axis + 2) % 3] = at.y();
    return m;
  }
};

/// True if the normal cone of a vertex meets the square. Clips the square by the half-plane of each
/// edge (Sutherland and Hodgman, 1974).
class ConeInSquare {
 public:
  bool operator()(const Square& square, std::span<const Vec3<double>> q, std::uint32_t vertex,
                  std::span<const std::uint32_t> neighbours) {
    polygon_.assign(square.corners.begin(), square.corners.end());
    for (const std::uint32_t other : neighbours) {
      const Vec3<double> edge = q[vertex] - q[other];
      const double slack = widening * edge.cwiseAbs().maxCoeff();
      const double constant = square.sign * edge[square.axis] + slack;
      const Eigen::Vector2d gradient(edge[(square.axis + 1) % 3], edge[(square.axis + 2) % 3]);
      clipped_.clear();
      for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const Eigen::Vector2d &a = polygon_[i], &b = polygon_[(i + 1) % polygon_.size()];
        const double at_a = constant + gradient.dot(a), at_b = constant + gradient.dot(b);
        if (at_a >= 0) clipped_.push_back(a);
        if ((at_a >= 0) != (at_b >= 0)) clipped_.push_back(a + (at_a / (at_a - at_b)) * (b - a));
      }
      polygon_.swap(clipped_);
      if (polygon_.empty()) return false;
    }
    return true;
  }

 private:
  std::vector<Eigen::Vector2d> polygon_, clipped_;
};

}  // namespace

DirectionTable::DirectionTable(const ConvexHull& hull, std::span<const Vec3<double>> vertices)
    : directions_(cells_per_vertex * static_cast<double>(vertices.size())) {
  // Only the ratios of the extents matter. With extents of at most 1, directions do not overflow.
  const Vec3<double> extents = hull.frame.extents / hull.frame.extents.maxCoeff();
  to_frame_ = extents.asDiagonal() * hull.frame.axes.transpose();
  begin_.reserve(directions_.cells() + 1);
  begin_.push_back(0);

  std::vector<Vec3<double>> q;
  q.reserve(vertices.size());
  for (const Vec3<double>& vertex : vertices) q.push_back(hull.frame.to_frame(vertex));
  const Polygons neighbours = neighbours_of(hull);
  const auto climb = [&](std::uint32_t vertex, const Vec3<double>& m) {
    for (bool climbed = true; climbed;) {
      climbed = false;
      for (const std::uint32_t other : neighbours[vertex])
        if (m.dot(q[other] - q[vertex]) > 0) vertex = other, climbed = true;
    }
    return vertex;
  };

  std::vector<std::size_t> seen_in(vertices.size(), 0);  // 1 + the last cell that visited it
  ConeInSquare meets;
  std::uint32_t start = 0;
  for (std::size_t cell = 0; cell < directions_.cells(); ++cell) {
    const auto [axis, sign, u, v, width] = directions_[cell];
    const double u0 = u - widening, v0 = v - widening;
    const double u1 = u + width + widening, v1 = v + width + widening;
    const Square square{axis, sign, {Eigen::Vector2d(u0, v0), {u1, v0}, {u1, v1}, {u0, v1}}};

    // Searches from the support point of the cell's middle, along edges: vertices whose cones meet
    // a convex cell are connected by edges.
    start = climb(start, square.direction({u + width / 2, v + width / 2}));
    lists_.push_back(start);
    seen_in[start] = cell + 1;
    for (std::size_t next = begin_.back(); next < lists_.size(); ++next) {
      for (const std::uint32_t other : neighbours[lists_[next]]) {
        if (seen_in[other] == cell + 1) continue;
        seen_in[other] = cell + 1;
        if (meets(square, q, other, neighbours[other])) lists_.push_back(other);
      }
    }
    // Sorts the list in the order of a scan of all vertices.
    std::sort(lists_.begin() + begin_.back(), lists_.end());
    begin_.push_back(static_cast<std::uint32_t>(lists_.size()));
  }
  lists_.shrink_to_fit();
}

}  // namespace minkray
