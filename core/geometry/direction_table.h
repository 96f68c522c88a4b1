// SPDX-License-Identifier: MIT
// Finds a polytope's support point from a cube map of directions. Each cell lists the vertices that
// are the support point of some direction in the cell, so a query reads one short list instead of
// all vertices. Unlike hill climbing, queries have no dependent steps, need no vertex adjacency,
// and cannot stall on a polytope that is not convex due to rounding.
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
  /// The hull must be flat or solid (rank 2 or 3); `vertices` are the points of hull.vertices, in
  /// the same order.
  DirectionTable(const ConvexHull& hull, std::span<const Vec3<double>> vertices);

  /// Returns the index (an integer) of the cell that contains n. NaN gets any cell.
  template <class W>
  W cell_of(const Vec3<W>& n) const {
    return directions_.cell_of(times<W>(Mat3<Lane<W>>(to_frame_.template cast<Lane<W>>()), n));
  }

  /// Returns the indices of one or more vertices. For each direction n of the cell, one of these
  /// vertices x maximises n.x.
  std::span<const std::uint32_t> candidates(std::size_t cell) const {
    return {lists_.data() + begin_[cell], lists_.data() + begin_[cell + 1]};
  }

  std::size_t memory_bytes() const {
    return (begin_.capacity() + lists_.capacity()) * sizeof(std::uint32_t);
  }
  std::size_t cells() const { return begin_.size() - 1; }

 private:
  /// Maps a direction n to m = extents * axes^T n, the same direction in the hull's round frame
  /// (RoundFrame). For a point p and its image q in that frame, n.p = m.q + constant. There the
  /// vertices' normal cones have similar sizes even if the hull is a needle.
  Mat3<double> to_frame_;
  CubeMap directions_;
  std::vector<std::uint32_t> begin_;  ///< per cell, start of its list in lists_
  std::vector<std::uint32_t> lists_;
};

}  // namespace minkray
