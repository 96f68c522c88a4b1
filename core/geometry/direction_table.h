// SPDX-License-Identifier: MIT
// Lists the vertices of a polytope that can be its support point, by direction: a cube map whose
// cells list the vertices with a normal cone that meets the cell. A query reads one short list
// instead of all vertices. Unlike hill climbing, queries have no dependent steps, cannot stall on a
// polytope that is not convex due to rounding, and need no vertex adjacency.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/geometry/cube_map.h"
#include "core/math/vec.h"

namespace minkray {

class DirectionTable {
 public:
  /// The hull has rank 2 or 3; `vertices` are its vertices in order.
  DirectionTable(const ConvexHull& hull, std::span<const Vec3<double>> vertices);

  /// Returns the index, an integer, of the cell of n. NaN gets any cell.
  template <class W>
  W cell_of(const Vec3<W>& n) const {
    return directions_.cell_of(times<W>(Mat3<Lane<W>>(to_frame_.template cast<Lane<W>>()), n));
  }

  /// Returns indices of vertices, at least one. For each direction n of the cell, one of the
  /// vertices maximises n.x.
  std::span<const std::uint32_t> candidates(std::size_t cell) const {
    return {lists_.data() + begin_[cell], lists_.data() + begin_[cell + 1]};
  }

  std::size_t memory_bytes() const {
    return (begin_.capacity() + lists_.capacity()) * sizeof(std::uint32_t);
  }
  std::size_t cells() const { return begin_.size() - 1; }

 private:
  /// Maps directions to the hull's round frame, in which the vertices' normal cones have similar
  /// sizes even if the hull is a needle: n.p = m.q + constant for m = extents * axes^T n.
  Mat3<double> to_frame_;
  CubeMap directions_;
  std::vector<std::uint32_t> begin_;  ///< per cell, begin of its list in lists_
  std::vector<std::uint32_t> lists_;
};

}  // namespace minkray
