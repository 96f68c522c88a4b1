// SPDX-License-Identifier: MIT
// The triangles of a polytope's surface and how they hang together, so that a line's way through
// the polytope can be found by walking from triangle to triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"
#include "core/shape/convex_hull.h"

namespace minkray {

/// Polygons are cut into fans of triangles. Everything that a step of a walk needs lies together.
template <class T>
class FacetMesh {
 public:
  struct Facet {
    std::array<Vec3<T>, 3> corners;  ///< counter-clockwise from outside
    Vec3<T> normal;                  ///< outward, of unit length; zero of a triangle without area
    std::array<std::uint32_t, 3> neighbours;  ///< facets: beyond the edge from corner k to k + 1
  };

  /// Of a hull of rank 3; `vertices` are its vertices in order.
  FacetMesh(const ConvexHull& hull, std::span<const Vec3<double>> vertices);

  template <class U>
  FacetMesh<U> cast() const {
    FacetMesh<U> converted;
    converted.facets_.reserve(facets_.size());
    for (const Facet& f : facets_)
      converted.facets_.push_back(
          {{f.corners[0].template cast<U>(), f.corners[1].template cast<U>(),
            f.corners[2].template cast<U>()},
           f.normal.template cast<U>(),
           f.neighbours});
    converted.resolution_ = resolution_;
    converted.facing_ = facing_;
    return converted;
  }

  const Facet& operator[](std::size_t i) const { return facets_[i]; }
  std::size_t size() const { return facets_.size(); }

  /// The index of a facet whose normal is near the direction n, of any length. NaN gets some facet.
  template <class W>
  W facing(const Vec3<W>& n) const {
    return lookup<W>(cell_of(n), [&](std::size_t cell) { return static_cast<T>(facing_[cell]); });
  }

  std::size_t memory_bytes() const {
    return facets_.capacity() * sizeof(Facet) + facing_.capacity() * sizeof(std::uint32_t);
  }

 private:
  template <class U>
  friend class FacetMesh;
  FacetMesh() = default;

  /// The cube's face by the largest component, the cell in it by the ratios of the others to it.
  template <class W>
  W cell_of(const Vec3<W>& n) const {
    using std::abs;
    const W x = abs(n.x()), y = abs(n.y()), z = abs(n.z());
    const Mask<W> along_x = (x >= y) & (x >= z), along_y = (!along_x) & (y >= z);
    const auto by_axis = [&](const W& if_x, const W& if_y, const W& if_z) {
      return select(along_x, if_x, select(along_y, if_y, if_z));
    };
    const W largest = by_axis(n.x(), n.y(), n.z()), over = W(1) / abs(largest);
    const W cells = W(static_cast<T>(resolution_)), last = cells - W(1);
    const auto index = [&](const W& component) {
      W scaled = (component * over + W(1)) * (W(T(0.5)) * cells);
      scaled = select(scaled > W(0), scaled, W(0));  // in this order: NaN falls to 0
      return whole(select(scaled < last, scaled, last));
    };
    const W face = by_axis(W(0), W(2), W(4)) + select(largest < W(0), W(1), W(0));
    return (face * cells + index(by_axis(n.y(), n.z(), n.x()))) * cells +
           index(by_axis(n.z(), n.x(), n.y()));
  }

  void link_neighbours(std::span<const std::array<std::uint32_t, 3>> corners);
  void fill_cube_map();

  std::vector<Facet> facets_;
  std::size_t resolution_ = 1;
  std::vector<std::uint32_t> facing_;  ///< by cell of a cube map
};

extern template class FacetMesh<float>;
extern template class FacetMesh<double>;

}  // namespace minkray
