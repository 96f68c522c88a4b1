// SPDX-License-Identifier: MIT
// Walking through a hierarchy for each instruction set: traverse_kernel.inl compiled once with each
// set's flags (core/CMakeLists.txt).
#pragma once

#include "core/bvh/bvh.h"
#include "core/bvh/ray_group.h"

namespace minkray {

/// It is told of the boxes that are met. It is a plain function, so that kernels share no code.
struct BoxVisitor {
  /// `rays`: those of a group that meet the box; of a single ray no more than bit 0. Answers
  /// whether to end the walk.
  bool (*visit)(void* context, std::uint32_t box, RayGroupMask rays);
  void* context;
  /// Told of boxes that may be visited soon, so that what they hold can be brought near.
  void (*expect)(const void* context, std::uint32_t box);
  const void* expect_context;
};

/// How many nodes were visited, and whether that was all: a group may have lost its patience, and
/// met just a part of the boxes.
struct Walk {
  std::uint32_t visited = 0;
  bool complete = true;
};

/// The visitor may lower t_max of the ray, or of rays and
/// the whole of the group.
Walk walk_sse2(const BvhNode* nodes, const SlabNumbers& ray, const BoxVisitor& visitor);
Walk walk_sse2(const BvhNode* nodes, const RayGroup& group, const BoxVisitor& visitor);

/// Only on machines that have AVX2 and FMA.
Walk walk_avx2(const BvhNode* nodes, const SlabNumbers& ray, const BoxVisitor& visitor);
Walk walk_avx2(const BvhNode* nodes, const RayGroup& group, const BoxVisitor& visitor);

}  // namespace minkray
