// SPDX-License-Identifier: MIT
// Slabs around the surface below each BVH node, perpendicular to the surface's mean normal. If the
// surface is nearly flat, a slab is thin for any orientation. An axis-aligned box is thin only for
// surfaces perpendicular to an axis.
#pragma once

#include <vector>

#include "core/bvh/bvh.h"

namespace minkray {

class TriangleMesh;

/// Each child of a node lies between two planes perpendicular to a normal, which need not have unit
/// length. The planes' offsets are relative to the middle of the mesh's box. A normal of 0 means
/// that there is no slab.
struct NodeSlabs {
  float normals[3][bvh_width];
  float low[bvh_width], high[bvh_width];

  Vec3<float> normal(int child) const {
    return {normals[0][child], normals[1][child], normals[2][child]};
  }
};

class MeshSlabs {
 public:
  explicit MeshSlabs(const TriangleMesh& mesh);

  const NodeSlabs& of(std::uint32_t node) const { return slabs_[node]; }
  std::size_t bytes() const { return slabs_.capacity() * sizeof(NodeSlabs); }

 private:
  std::vector<NodeSlabs> slabs_;
};

}  // namespace minkray
