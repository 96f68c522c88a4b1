// SPDX-License-Identifier: MIT
#include "core/parts/body_tree.h"

#include <cmath>

#include "core/pair/core_support.h"

namespace minkray {
namespace {

/// A box number contains the numbers of a node and of a child; none of these equals `whole`.
static_assert(bvh_width == 8 && EightBoxes::most == 8);

/// Largest n . p over the shape's points p, relative to its middle.
double reach_from_middle(const ContactShape& shape, const Vec3<double>& n) {
  const Vec3<double> d = shape.turn().transpose() * n;
  return d.dot(support_of_core<CoreKind::other>(shape.core(), d).point) +
         (shape.core().radius + shape.core().rounding) * n.norm();
}

/// Half extents about the shape's middle, along the axes of its frame.
Vec3<double> half_extents(const ContactShape& shape, Vec3<double>& middle) {
  Vec3<double> half;
  for (int axis = 0; axis < 3; ++axis) {
    const auto reach = [&](double way) {
      const Vec3<double> d = way * shape.turn().row(axis).transpose();
      return d.dot(support_of_core<CoreKind::other>(shape.core(), d).point);
    };
    const double up = reach(1), down = reach(-1);
    middle[axis] = (up - down) / 2;
    half[axis] = (up + down) / 2 + shape.core().radius + shape.core().rounding;
  }
  return half;
}

}  // namespace

BodyTree::BodyTree(const PartsBody& body) : body_(body), middle_(middle_of(body)) {
  if (mesh()) {
    bvh_ = &mesh()->bvh();
    slabs_ = &mesh()->slabs();
    whole_ = about_middle(mesh()->bounds());
  } else if (const Compound* const compound = body.compound()) {
    bvh_ = &compound->bvh();
    whole_ = about_middle(compound->bounds());
  }
  if (bvh_) {
    radius_ = whole_.half.norm();
    // Boxes of floats may be larger than a body of the least size.
    const BvhNode& root = bvh_->nodes[0];
    for (int i = 0; i < bvh_width && root.children[i] != BvhNode::none; ++i) {
      const MiddleBox box = about_middle(root.box(i));
      const double reach = (box.middle.cwiseAbs() + box.half).norm();
      if (std::isfinite(reach)) radius_ = std::max(radius_, reach);
    }
    return;
  }
  whole_.half = half_extents(*body.shape(), whole_.middle);
  radius_ = body.shape()->ball_radius() + body.shape()->core().rounding;
}

int BodyTree::open(Box box, EightBoxes& boxes, Box* children) const {
  const std::uint32_t number = inside(box);
  const BvhNode& node = bvh_->nodes[number];
  int count = 0;
  while (count < bvh_width && node.children[count] != BvhNode::none) ++count;
  for (int i = 0; i < count; ++i) children[i] = number << 3 | static_cast<std::uint32_t>(i);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < bvh_width; ++i) {
      const double lower = double{node.planes[0][axis][i]} - middle_[axis],
                   upper = double{node.planes[1][axis][i]} - middle_[axis];
      boxes.middle[axis][i] = (lower + upper) / 2;
      boxes.half[axis][i] = (upper - lower) / 2;
    }
  static constexpr NodeSlabs none = {};
  const NodeSlabs& slabs = slabs_ ? slabs_->of(number) : none;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < bvh_width; ++i) boxes.normal[axis][i] = double{slabs.normals[axis][i]};
  for (int i = 0; i < bvh_width; ++i) {
    boxes.low[i] = double{slabs.low[i]};
    boxes.high[i] = double{slabs.high[i]};
  }
  return count;
}

int BodyTree::open_leaf(Box box, EightBoxes& boxes, std::uint32_t* parts) const {
  int count = 1;
  if (is_shape()) {
    boxes.set(0, whole_);
    parts[0] = 0;
  } else if (!mesh()) {
    parts[0] = inside(box) & ~BvhNode::leaf;
    boxes.set(0, about_middle(body_.compound()->bounds_of_part(parts[0])));
  } else {
    const MeshLeaf& leaf = mesh()->leaves()[inside(box) & ~BvhNode::leaf];
    count = leaf.size();
    for (int i = 0; i < count; ++i) {
      parts[i] = leaf.triangles[i];
      Bounds<double> bounds;
      for (std::size_t k = 0; k < 3; ++k) bounds.extend(mesh()->corner(parts[i], k));
      boxes.set(i, about_middle(bounds));
    }
  }
  for (int i = count; i < EightBoxes::most; ++i) boxes.set(i, {});
  return count;
}

void BodyTree::open_leaf(Box box, EightTriangles& triangles, const Turned* at) const {
  const MeshLeaf& leaf = mesh()->leaves()[inside(box) & ~BvhNode::leaf];
  triangles.count = leaf.size();
  for (int i = 0; i < triangles.count; ++i) {
    TriangleCorners corners = triangle(leaf.triangles[i]);
    if (at)
      for (Vec3<double>& corner : corners) corner = at->turn * corner + at->shift;
    triangles.set(i, leaf.triangles[i], corners);
  }
  triangles.finish();
}

double BodyTree::reach_along(const Vec3<double>& n) const {
  if (!is_shape()) return minkray::reach_along(whole_, n);
  return reach_from_middle(*body_.shape(), n);
}

double BodyTree::reach_of_part(std::uint32_t part, const Vec3<double>& n) const {
  if (mesh()) return minkray::reach_along(triangle(part), n);
  const ContactShape& shape = body_.compound()->contact(part);
  return n.dot((shape.exact_middle() - TwoFoldVec3<double>(middle_)).rounded()) +
         reach_from_middle(shape, n);
}

}  // namespace minkray
