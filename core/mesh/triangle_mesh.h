// SPDX-License-Identifier: MIT
// A triangle mesh with shared vertices, and its BVH: a body of many convex parts with one pose.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/math/bounds.h"
#include "core/math/vec.h"
#include "core/mesh/mesh_leaf.h"
#include "core/mesh/mesh_slabs.h"

namespace minkray {

/// Indices of three vertices, counter-clockwise as seen from outside.
using Corners = std::array<std::uint32_t, 3>;

/// Number that means "no part"; also used for shapes, which have only one part.
inline constexpr std::uint32_t no_part = ~std::uint32_t{0};

/// Defects of a mesh; vertices at the same position count as one. Results are correct in spite of
/// defects: for example, rays hit the neighbours of a triangle without area.
struct MeshFaults {
  std::size_t without_area = 0;  ///< triangles without area
  std::size_t repeated = 0;      ///< triangles with the same vertices as another
  /// edges that triangles do not use equally often in both directions; repeats with the same order
  /// of vertices count once
  std::size_t open_edges = 0;
  bool is_closed() const { return open_edges == 0; }
};

/// Sides from which rays hit triangles. For `front`, all triangles must face the same way.
enum class MeshSides : unsigned char { both, front };

/// Immutable: any number of threads may use a mesh, and any number of instances may share it.
class TriangleMesh {
 public:
  /// Triangles keep their numbers. Throws std::invalid_argument if there are none or more than
  /// 2^30, a vertex number is out of range, or a coordinate is unusable (not finite, too large or
  /// too small).
  TriangleMesh(std::vector<Vec3<double>> vertices, std::vector<Corners> triangles,
               MeshSides sides = MeshSides::both);

  std::span<const Vec3<double>> vertices() const { return vertices_; }
  std::span<const Corners> triangles() const { return triangles_; }
  std::size_t size() const { return triangles_.size(); }
  MeshSides sides() const { return sides_; }

  const Vec3<double>& corner(std::uint32_t triangle, std::size_t k) const {
    return vertices_[triangles_[triangle][k]];
  }
  /// Unit normal by the right-hand rule; zero for a triangle without area.
  Vec3<double> normal(std::uint32_t triangle) const;

  /// Bounding box of the vertices that triangles use.
  const Bounds<double>& bounds() const { return bounds_; }
  /// The BVH. Children with the leaf bit are indices into leaves().
  const Bvh& bvh() const { return bvh_; }
  std::span<const MeshLeaf> leaves() const { return leaves_; }
  /// Boxes of a leaf's triangles. Children with the leaf bit are numbers of triangles.
  BvhNode boxes_of_leaf(std::uint32_t leaf) const;
  /// True if float lanes can test leaves: the mesh's size and numbers are far from float's limits.
  bool suits_lanes() const { return suits_lanes_; }
  /// Counts the defects; checks all triangles at each call.
  MeshFaults faults() const;
  /// Returns faults().is_closed(), computed once.
  bool is_closed() const;
  /// Returns the slabs, built at the first call; rays need none.
  const MeshSlabs& slabs() const;
  /// Upper bound of the vertices' distances from the frame's origin.
  double reach() const { return reach_; }

  std::size_t bytes() const;

 private:
  std::vector<Vec3<double>> vertices_;
  std::vector<Corners> triangles_;
  Bounds<double> bounds_;
  double reach_ = 0;
  MeshSides sides_ = MeshSides::both;
  mutable std::once_flag closed_once_;
  mutable bool is_closed_ = false;
  mutable std::once_flag slabs_once_;
  mutable std::unique_ptr<const MeshSlabs> slabs_;
  bool suits_lanes_ = false;
  Bvh bvh_;
  FirstTouchVector<MeshLeaf> leaves_;
};

}  // namespace minkray
