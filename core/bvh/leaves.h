// SPDX-License-Identifier: MIT
// Hierarchies with several boxes in a leaf, for contents that lanes look at together.
#pragma once

#include "core/bvh/bvh.h"

namespace minkray {

/// Its children with the leaf bit are numbers of leaves.
struct BvhOfLeaves {
  Bvh bvh;
  FirstTouchVector<std::uint32_t> boxes;   ///< numbers of all boxes, leaf by leaf
  FirstTouchVector<std::uint32_t> begins;  ///< where each leaf begins, and where the last one ends
};

/// As build_bvh for fast rays, with up to bvh_width boxes in each leaf, and nearly as many in most.
BvhOfLeaves build_bvh_of_leaves(FirstTouchVector<Bounds<float>>&& boxes);

}  // namespace minkray
