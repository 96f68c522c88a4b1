// SPDX-License-Identifier: MIT
// A surface of triangles with shared vertices, and a hierarchy of their boxes: a body of many
// convex parts under one pose, where a shape is a body of one.
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

/// Three vertices by their numbers, counter-clockwise as seen from outside.
using Corners = std::array<std::uint32_t, 3>;

/// "No part": of a shape, which is one.
inline constexpr std::uint32_t no_part = ~std::uint32_t{0};

/// What its triangles are like, where vertices at one place are one. None of this makes an answer
/// wrong: triangles without area are met by no ray, since those beside them are.
struct MeshFaults {
  std::size_t without_area = 0;
  std::size_t repeated = 0;  ///< triangles of three vertices that another has, too
  std::size_t open_edges =
      0;  ///< edges that have not as many triangles on one side as on the other
  bool is_closed() const { return open_edges == 0; }
};

/// From where rays meet triangles. With `front` all of them must look the same way.
enum class MeshSides : unsigned char { both, front };

/// It never changes: any number of threads may use it, and any number of instances share it.
class TriangleMesh {
 public:
  /// Triangles keep their numbers. Throws std::invalid_argument where there is none, more than
  /// 2^30, a number of no vertex, or a coordinate that is not finite, too large or too small.
  TriangleMesh(std::vector<Vec3<double>> vertices, std::vector<Corners> triangles,
               MeshSides sides = MeshSides::both);

  std::span<const Vec3<double>> vertices() const { return vertices_; }
  std::span<const Corners> triangles() const { return triangles_; }
  std::size_t size() const { return triangles_.size(); }
  MeshSides sides() const { return sides_; }

  const Vec3<double>& corner(std::uint32_t triangle, std::size_t k) const {
    return vertices_[triangles_[triangle][k]];
  }
  /// It has unit length and follows the right-hand rule; it is zero of a triangle without area.
  Vec3<double> normal(std::uint32_t triangle) const;

  /// The box holds the vertices that triangles have.
  const Bounds<double>& bounds() const { return bounds_; }
  /// Its children with the leaf bit are numbers of leaves().
  const Bvh& bvh() const { return bvh_; }
  std::span<const MeshLeaf> leaves() const { return leaves_; }
  /// The boxes of a leaf's triangles: children with the leaf bit are numbers of triangles.
  BvhNode boxes_of_leaf(std::uint32_t leaf) const;
  /// True if float lanes may look at leaves: its size and its numbers are far from float's limits.
  bool suits_lanes() const { return suits_lanes_; }
  /// Looks at all triangles each time.
  MeshFaults faults() const;
  /// Finds out once what faults().is_closed() says.
  bool is_closed() const;
  /// Makes them once, for whoever asks first: rays need none.
  const MeshSlabs& slabs() const;
  /// The furthest vertex' distance from the frame's origin, or a little more.
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
