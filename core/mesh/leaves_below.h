// SPDX-License-Identifier: MIT
// Visits the leaves below a node of a mesh's BVH.
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// Calls each(leaf) for all leaves below `what`, which is the index of a node, or the index of a
/// leaf with the leaf bit set.
template <class Each>
void each_leaf_below(const TriangleMesh& mesh, std::uint32_t what, Each&& each) {
  std::vector<std::uint32_t> open{what};
  while (!open.empty()) {
    const std::uint32_t top = open.back();
    open.pop_back();
    if ((top & BvhNode::leaf) != 0) {
      each(mesh.leaves()[top & ~BvhNode::leaf]);
      continue;
    }
    for (const std::uint32_t child : mesh.bvh().nodes[top].children)
      if (child != BvhNode::none) open.push_back(child);
  }
}

}  // namespace minkray
