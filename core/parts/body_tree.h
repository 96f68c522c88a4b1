// SPDX-License-Identifier: MIT
// A body prepared for traversals of pairs of parts (pair_walk.h): nested boxes relative to the
// body's middle, down to leaves of up to eight triangles, or of one part of a compound. A shape is
// one leaf with one part.
#pragma once

#include "core/parts/box_gaps.h"
#include "core/parts/parts_body.h"
#include "core/parts/triangle_lanes.h"

namespace minkray {

class BodyTree {
 public:
  explicit BodyTree(const PartsBody& body);

  const PartsBody& body() const { return body_; }
  const TriangleMesh* mesh() const { return body_.mesh(); }
  /// True for a shape, whose only box is the whole.
  bool is_shape() const { return !bvh_; }
  /// Middle of the body, in its frame.
  const Vec3<double>& middle() const { return middle_; }
  /// Radius of a ball around the middle that contains the body.
  double radius() const { return radius_; }

  /// Number of a box: the body's own box, or that of a node's child. Encodes the node's number and
  /// the child's index.
  using Box = std::uint32_t;
  static constexpr Box whole = ~Box{0};  ///< the body's own box

  bool is_leaf(Box box) const { return is_shape() || (inside(box) & BvhNode::leaf) != 0; }
  MiddleBox bounds(Box box) const {
    return box == whole ? whole_ : child(box >> 3, static_cast<int>(box & 7));
  }

  /// Writes the boxes inside a box that is not a leaf. Returns their number.
  int open(Box box, EightBoxes& boxes, Box* children) const;
  /// Writes the boxes of a leaf's parts. Returns their number.
  int open_leaf(Box box, EightBoxes& boxes, std::uint32_t* parts) const;

  /// Writes the triangles of a mesh's leaf, relative to the body's middle. Maps them by `at`, if
  /// not null.
  void open_leaf(Box box, EightTriangles& triangles, const Turned* at = nullptr) const;

  /// Corners of a mesh's triangle, relative to the body's middle.
  TriangleCorners triangle(std::uint32_t part) const {
    return {mesh()->corner(part, 0) - middle_, mesh()->corner(part, 1) - middle_,
            mesh()->corner(part, 2) - middle_};
  }
  /// Largest n . p over the body's points p, relative to the body's middle and in the body's frame.
  /// For a mesh or compound: over the points of its box.
  double reach_along(const Vec3<double>& n) const;
  /// Upper bound of n . p over the points p of a part of a mesh or compound.
  double reach_of_part(std::uint32_t part, const Vec3<double>& n) const;

 private:
  /// Number of a node, or number of a leaf with the leaf bit set.
  std::uint32_t inside(Box box) const {
    return box == whole ? 0 : bvh_->nodes[box >> 3].children[box & 7];
  }
  template <class T>
  MiddleBox about_middle(const Bounds<T>& box) const {
    const Vec3<double> lower = box.lower.template cast<double>() - middle_,
                       upper = box.upper.template cast<double>() - middle_;
    MiddleBox about;
    about.middle = (lower + upper) / 2;
    about.half = (upper - lower) / 2;
    return about;
  }

  MiddleBox child(std::uint32_t node, int number) const {
    MiddleBox box = about_middle(bvh_->nodes[node].box(number));
    if (!slabs_) return box;
    const NodeSlabs& slabs = slabs_->of(node);
    box.normal = slabs.normal(number).cast<double>();
    box.low = double{slabs.low[number]};
    box.high = double{slabs.high[number]};
    return box;
  }

  PartsBody body_;
  const Bvh* bvh_ = nullptr;          ///< null for a shape
  const MeshSlabs* slabs_ = nullptr;  ///< null unless the body is a mesh
  Vec3<double> middle_;
  MiddleBox whole_;
  double radius_;
};

}  // namespace minkray
