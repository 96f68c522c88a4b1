// SPDX-License-Identifier: MIT
// Slabs around the parts of a surface below each node, across their mean normals: thin where the
// surface is nearly flat, however it lies, where boxes along the axes are as thick as the part.
#pragma once

#include <vector>

#include "core/bvh/bvh.h"

namespace minkray {

class TriangleMesh;

/// Between two planes across `normal`, which need not have unit length; about the middle of the
/// mesh's box. A normal of 0 is no slab.
struct Slab {
  Vec3<float> normal = Vec3<float>::Zero();
  float low = 0, high = 0;
};

/// By node and child.
class MeshSlabs {
 public:
  explicit MeshSlabs(const TriangleMesh& mesh);

  const Slab& of(std::uint32_t node, std::uint32_t child) const {
    return slabs_[std::size_t{node} * bvh_width + child];
  }
  std::size_t bytes() const { return slabs_.capacity() * sizeof(Slab); }

 private:
  std::vector<Slab> slabs_;
};

}  // namespace minkray
