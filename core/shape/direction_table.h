// SPDX-License-Identifier: MIT
// Which of a polytope's vertices can be its support point, by direction: a cube map whose cells
// list the vertices with a normal cone that meets the cell. A query reads one short list instead of
// all vertices; unlike hill climbing it has no steps that wait for each other, cannot stall where
// rounding has left the polytope dented, and needs no vertex adjacency.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"
#include "core/shape/convex_hull.h"

namespace minkray {

class DirectionTable {
 public:
  /// Of a hull of rank 2 or 3; `vertices` are its vertices in order.
  DirectionTable(const ConvexHull& hull, std::span<const Vec3<double>> vertices);

  /// Indices of vertices, never empty, with one among them that maximises n.x. NaN gets some list.
  template <class T>
  std::span<const std::uint32_t> candidates(const Vec3<T>& n) const {
    const std::size_t cell = cell_of(to_frame(n));
    return {lists_.data() + begin_[cell], lists_.data() + begin_[cell + 1]};
  }

  std::size_t memory_bytes() const {
    return (begin_.capacity() + lists_.capacity()) * sizeof(std::uint32_t);
  }
  std::size_t cells() const { return begin_.size() - 1; }

 private:
  /// Directions in the hull's round frame, where the vertices' normal cones are of similar size
  /// even if the hull is a needle: n.p = m.q + constant for m = extents * axes^T n.
  template <class T>
  Vec3<T> to_frame(const Vec3<T>& n) const {
    const auto row = [&](int i) {
      return T(rows_(i, 0)) * n.x() + T(rows_(i, 1)) * n.y() + T(rows_(i, 2)) * n.z();
    };
    return {row(0), row(1), row(2)};
  }

  /// The cube's face by the largest component, the cell in it by the ratios of the others to it.
  template <class T>
  std::size_t cell_of(const Vec3<T>& m) const {
    const T x = std::abs(m.x()), y = std::abs(m.y()), z = std::abs(m.z());
    const int axis = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
    const T largest = m[axis];
    const std::size_t face = static_cast<std::size_t>(2 * axis + (largest < T(0) ? 1 : 0));
    return (face * resolution_ + index(m[(axis + 1) % 3] / std::abs(largest))) * resolution_ +
           index(m[(axis + 2) % 3] / std::abs(largest));
  }

  /// Order matters: NaN must fall to 0.
  template <class T>
  std::size_t index(T ratio) const {
    const T scaled = (ratio + T(1)) * (T(0.5) * static_cast<T>(resolution_));
    const T clamped = scaled > T(0) ? scaled : T(0);
    const T last = static_cast<T>(resolution_ - 1);
    return static_cast<std::size_t>(clamped < last ? clamped : last);
  }

  Mat3<double> rows_;
  std::size_t resolution_;
  std::vector<std::uint32_t> begin_;  ///< per cell, where its list begins in lists_
  std::vector<std::uint32_t> lists_;
};

}  // namespace minkray
