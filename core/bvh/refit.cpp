// SPDX-License-Identifier: MIT
#include "core/bvh/bvh.h"

namespace minkray {
namespace {

template <class OnChild>
void for_children(const BvhNode& node, const OnChild& on_child) {
  for (int child = 0; child < bvh_width && node.children[child] != BvhNode::none; ++child)
    on_child(child, node.children[child]);
}

Bounds<float> union_of(const BvhNode& node) {
  Bounds<float> bounds;
  for_children(node, [&](int child, std::uint32_t) { bounds.extend(node.box(child)); });
  return bounds;
}

double half_area(const Bounds<float>& box) {
  const Vec3<double> extent = box.upper.cast<double>() - box.lower.cast<double>();
  return extent.x() * extent.y() + extent.y() * extent.z() + extent.z() * extent.x();
}

}  // namespace

void refit(Bvh& bvh, std::span<const Bounds<float>> boxes) {
  // Children follow their parents, so in a backward loop they are refitted before their parents.
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    BvhNode& node = bvh.nodes[i];
    for_children(node, [&](int child, std::uint32_t what) {
      const bool is_leaf = what & BvhNode::leaf;
      node.set(child, is_leaf ? boxes[what & ~BvhNode::leaf] : union_of(bvh.nodes[what]), what);
    });
  }
}

VisitEstimate expected_visits(const Bvh& bvh) {
  VisitEstimate visits;
  if (bvh.nodes.empty()) return visits;
  const double whole = half_area(union_of(bvh.nodes[0]));
  visits.nodes = 1;
  for (const BvhNode& node : bvh.nodes)
    for_children(node, [&](int child, std::uint32_t what) {
      (what & BvhNode::leaf ? visits.leaves : visits.nodes) += half_area(node.box(child)) / whole;
    });
  return visits;
}

}  // namespace minkray
