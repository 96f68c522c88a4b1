// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over boxes, independent of their contents.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/bounds.h"
#include "core/parallel/first_touch.h"

namespace minkray {

/// Children of a node: as many boxes as fill a register of AVX2.
inline constexpr int bvh_width = 8;

/// Up to eight boxes, coordinate by coordinate, and what is in each. Boxes are rounded outwards to
/// float whatever the scalar of the rays, which costs at most a few visits more.
struct alignas(32) BvhNode {
  /// No such child: the box is empty, and so are all that follow.
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// A child with this bit is one of the boxes that the hierarchy was built of, the rest is its
  /// index; otherwise it is a node.
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

/// Node 0 is the root; no nodes at all if there are no boxes. Children follow their parents.
struct Bvh {
  FirstTouchVector<BvhNode> nodes;

  std::size_t bytes() const { return nodes.capacity() * sizeof(BvhNode); }
};

/// No path from the root is longer than this, whatever the boxes.
inline constexpr int bvh_max_depth = 80;

/// Build time or quality of a hierarchy (docs/decisions/many-rays.md).
enum class BvhBuild : unsigned char {
  quality,  ///< by the surface area heuristic in bins (Wald 2007)
  speed,    ///< along a space-filling curve (Lauterbach et al. 2009)
};

/// The hierarchy of boxes [0, count), which must be at most 2^30. The same for any number of
/// threads. The boxes must not be empty; they may be flat, alike, or infinite.
Bvh build_bvh(std::span<const Bounds<float>> boxes, BvhBuild build = BvhBuild::quality);
/// Frees the boxes as soon as they are read.
Bvh build_bvh(FirstTouchVector<Bounds<float>>&& boxes, BvhBuild build = BvhBuild::quality);

/// Refits the hierarchy to other boxes: those of objects that have moved. The further they moved
/// against each other, the more nodes rays visit needlessly; rays find the same as after a
/// rebuild.
void refit(Bvh& bvh, std::span<const Bounds<float>> boxes);

/// Expected number of nodes, and of boxes in leaves, visited by a random line that meets the
/// root's box: the sums of surface areas over that of the root. The surface area heuristic
/// minimises these.
struct VisitEstimate {
  double nodes = 0, leaves = 0;
};
VisitEstimate expected_visits(const Bvh& bvh);

}  // namespace minkray
