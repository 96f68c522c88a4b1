// SPDX-License-Identifier: MIT
// The triangles of a polytope's surface and their adjacency. A walk from triangle to triangle finds
// where a line enters the polytope.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/geometry/cube_map.h"
#include "core/math/gather_rows.h"

namespace minkray {

/// Polygons are split into fans of triangles. The data for one step of a walk form a row of
/// numbers, which packets of rays read together.
class FacetMesh {
 public:
  class Facet {
   public:
    /// Positions in the facet's row of numbers: the three corners, the three neighbours, the
    /// normal, and a flag that is 1 if is_supported().
    static constexpr std::size_t corners = 0, neighbours = 9, normals = 12, supported = 15;
    static constexpr std::size_t size = 16;

    Facet() = default;
    explicit Facet(const std::array<Vec3<double>, 3>& counter_clockwise);

    /// Corners are counter-clockwise from outside.
    Vec3<double> corner(std::size_t k) const { return vector_at(corners + 3 * k); }
    /// Outward normal of unit length; zero for a triangle without area.
    Vec3<double> normal() const { return vector_at(normals); }
    /// The facet beyond the edge from corner k to k + 1.
    std::size_t neighbour(std::size_t k) const {
      return static_cast<std::size_t>(numbers_[neighbours + k]);
    }
    /// True if corner 0 is a support point of the hull in the direction of the normal, and the
    /// other corners reach as far up to rounding. The facet is then also so thick that rounding
    /// does not decide if a line passes through it.
    bool is_supported() const { return numbers_[supported] != 0.0; }

   private:
    friend class FacetMesh;
    Vec3<double> vector_at(std::size_t i) const {
      return {numbers_[i], numbers_[i + 1], numbers_[i + 2]};
    }
    /// Uses the shorter edges, since these have the least rounding.
    void find_normal();
    /// The least height of the triangle.
    double thickness() const;
    /// Rotates the corners so that corner k becomes corner 0.
    void turn(std::size_t k);

    alignas(4 * sizeof(double)) std::array<double, size> numbers_ = {};
  };

  /// The hull must be solid (rank 3); `vertices` are the points of hull.vertices, in the same
  /// order.
  FacetMesh(const ConvexHull& hull, std::span<const Vec3<double>> vertices);

  /// Determines which facets are supported, and by which corner; furthest(n) must return the hull's
  /// support point in direction n.
  template <class Furthest>
  void find_supported(Furthest&& furthest) {
    double largest(0);
    for (const Facet& facet : facets_)
      for (std::size_t k = 0; k < 3; ++k)
        largest = std::max(largest, facet.corner(k).cwiseAbs().maxCoeff());
    for (Facet& facet : facets_) {
      const Vec3<double> normal = facet.normal();
      const auto reach = [&](std::size_t k) { return normal.dot(facet.corner(k)); };
      facet.turn(reach(1) > reach(0) ? (reach(2) > reach(1) ? 2 : 1)
                                     : (reach(2) > reach(0) ? 2 : 0));
      const bool fits = reach(0) - std::min(reach(1), reach(2)) <= uneven * largest;
      const bool supported =
          fits && facet.thickness() > thin * largest && reach(0) >= normal.dot(furthest(normal));
      facet.numbers_[Facet::supported] = supported ? 1.0 : 0.0;
    }
  }

  /// False for a hull that is thinner than the rounding of its points: its facets are meaningless.
  bool is_supported() const {
    return std::any_of(facets_.begin(), facets_.end(),
                       [](const Facet& facet) { return facet.numbers_[Facet::supported] > 0.0; });
  }

  const Facet& operator[](std::size_t i) const { return facets_[i]; }
  std::size_t size() const { return facets_.size(); }

  /// Returns the index of a facet whose normal is near the direction n, which may have any length.
  /// NaN gets any facet.
  template <class W>
  W facing(const Vec3<W>& n) const {
    return lookup<W>(directions_.cell_of(n),
                     [&](std::size_t cell) { return static_cast<double>(facing_[cell]); });
  }

  /// Returns `count` numbers of each lane's facet, from position `first` of its row.
  template <std::size_t first, std::size_t count, class W>
  std::array<W, count> numbers(const W& facet) const {
    static_assert(sizeof(Facet) == Facet::size * sizeof(double));
    return gather_row<count>(facet, facets_.front().numbers_.data() + first, Facet::size);
  }

  std::size_t memory_bytes() const {
    return facets_.capacity() * sizeof(Facet) + facing_.capacity() * sizeof(std::uint32_t);
  }

 private:
  /// Tolerances relative to the largest coordinate. `uneven`: a few rounding errors of a corner's
  /// reach along the normal. `thin`: many rounding errors of a corner's position in the ray's
  /// frame.
  static constexpr double uneven = 16 * std::numeric_limits<double>::epsilon();
  static constexpr double thin = 64 * std::numeric_limits<double>::epsilon();

  void link_neighbours(std::span<const std::array<std::uint32_t, 3>> corners);
  void fill_cube_map();

  std::vector<Facet> facets_;
  CubeMap directions_{1};
  std::vector<std::uint32_t> facing_;  ///< per cell of directions_: index of a facet
};

}  // namespace minkray
