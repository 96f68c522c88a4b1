// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over boxes. It knows nothing of what is in them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/bounds.h"

namespace minkray {

/// 32 bytes whatever the scalar of the rays: boxes are rounded outwards to float, which costs at
/// most a few visits more, and rays are tested in their own scalar.
struct BvhNode {
  float planes[2][3];   ///< lower corner, upper corner
  std::uint32_t first;  ///< leaf: into Bvh::primitives; else the left child, the right one follows
  std::uint32_t count;  ///< how many primitives a leaf has; 0: not a leaf

  bool is_leaf() const { return count != 0; }
};
static_assert(sizeof(BvhNode) == 32);

/// Node 0 is the root; no nodes at all if there are no primitives.
struct Bvh {
  std::vector<BvhNode> nodes;
  std::vector<std::uint32_t> primitives;  ///< indices of the boxes, in the order of the leaves

  std::size_t bytes() const {
    return nodes.capacity() * sizeof(BvhNode) + primitives.capacity() * sizeof(std::uint32_t);
  }
};

/// No path from the root is longer than this, whatever the boxes.
inline constexpr int bvh_max_depth = 80;

/// The hierarchy of boxes [0, count), by the surface area heuristic in bins (Wald, "On fast
/// Construction of SAH-based Bounding Volume Hierarchies", 2007). The same for any number of
/// threads. The boxes must not be empty; they may be flat, alike, or infinite.
template <class T>
Bvh build_bvh(std::span<const Bounds<T>> boxes);

extern template Bvh build_bvh(std::span<const Bounds<float>>);
extern template Bvh build_bvh(std::span<const Bounds<double>>);

}  // namespace minkray
