// SPDX-License-Identifier: MIT
// Hierarchies with several boxes per leaf, whose contents are tested together in SIMD lanes.
#pragma once

#include "core/bvh/bvh.h"

namespace minkray {

/// A hierarchy in which a child with the leaf bit is the index of a leaf.
struct BvhOfLeaves {
  Bvh bvh;
  FirstTouchVector<std::uint32_t> boxes;   ///< numbers of all boxes, leaf by leaf
  FirstTouchVector<std::uint32_t> begins;  ///< start of each leaf; then the end of the last
};

/// Same as build_bvh with BvhBuild::quality, but with up to bvh_width boxes per leaf; most leaves
/// are nearly full.
BvhOfLeaves build_bvh_of_leaves(FirstTouchVector<Bounds<float>>&& boxes);

}  // namespace minkray
