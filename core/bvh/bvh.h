// SPDX-License-Identifier: MIT
// A bounding volume hierarchy (BVH) over boxes, independent of what the boxes contain.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/bounds.h"
#include "core/parallel/first_touch.h"

namespace minkray {

/// Maximum number of children per node: the number of floats in an AVX2 register.
inline constexpr int bvh_width = 8;

/// A node: up to eight boxes, coordinate by coordinate, and the child in each box. Boxes are
/// rounded outwards to float, also for rays in double; this costs at most a few more visits.
struct alignas(32) BvhNode {
  /// Value of a child that does not exist. Its box and all following boxes are empty.
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// If this bit of a child is set, the other bits are the index of a box that the hierarchy was
  /// built from. Otherwise the child is the index of a node.
  static constexpr std::uint32_t leaf = std::uint32_t{1} << 31;

  float planes[2][3][bvh_width];  ///< lower corners, upper corners
  std::uint32_t children[bvh_width];

  Bounds<float> box(int child) const {
    const auto at = [&](int corner) {
      const auto& from = planes[corner];
      return Vec3<float>(from[0][child], from[1][child], from[2][child]);
    };
    return {at(0), at(1)};
  }
  void set(int child, const Bounds<float>& box, std::uint32_t what) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[0][axis][child] = box.lower[axis];
      planes[1][axis][child] = box.upper[axis];
    }
    children[child] = what;
  }
};
static_assert(sizeof(BvhNode) == 224);

/// Node 0 is the root; each child has a larger index than its parent. Without boxes there are no
/// nodes.
struct Bvh {
  FirstTouchVector<BvhNode> nodes;

  std::size_t bytes() const { return nodes.capacity() * sizeof(BvhNode); }
};

/// Upper bound of the length of any path from the root, for any boxes.
inline constexpr int bvh_max_depth = 80;

/// Preference of build quality or build speed (docs/decisions/many-rays.md).
enum class BvhBuild : unsigned char {
  quality,  ///< by the surface area heuristic in bins (Wald 2007)
  speed,    ///< along a space-filling curve (Lauterbach et al. 2009)
};

/// Builds the hierarchy of at most 2^30 boxes. The result does not depend on the number of threads.
/// The boxes must not be empty; they may be flat, equal, or infinite.
Bvh build_bvh(std::span<const Bounds<float>> boxes, BvhBuild build = BvhBuild::quality);
/// Same, but frees the boxes as soon as possible.
Bvh build_bvh(FirstTouchVector<Bounds<float>>&& boxes, BvhBuild build = BvhBuild::quality);

/// Refits the hierarchy to the new boxes of the same objects, without changing its structure. Rays
/// find the same boxes as after a rebuild, but visit more nodes the further objects moved relative
/// to each other.
void refit(Bvh& bvh, std::span<const Bounds<float>> boxes);

/// Expected numbers of nodes, and of boxes in leaves, that a random line visits if it meets the
/// root's box: the sum of the surface areas of their boxes, divided by the surface area of the
/// root's box. The surface area heuristic minimises both numbers.
struct VisitEstimate {
  double nodes = 0, leaves = 0;
};
VisitEstimate expected_visits(const Bvh& bvh);

}  // namespace minkray
