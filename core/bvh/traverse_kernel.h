// SPDX-License-Identifier: MIT
// Traversals of a hierarchy, one function per instruction set: traverse_kernel.inl is compiled once
// with the flags of each set (core/CMakeLists.txt).
#pragma once

#include "core/bvh/bvh.h"
#include "core/bvh/slab_ray.h"

namespace minkray {

/// Receives the boxes that the ray meets. Uses function pointers, so that kernels for different
/// instruction sets share no code.
struct BoxVisitor {
  /// Returns true to end the traversal. May lower t_max of the ray.
  bool (*visit)(void* context, std::uint32_t box);
  void* context;
  /// Receives boxes that may be visited soon, so that their contents can be prefetched.
  void (*expect)(const void* context, std::uint32_t box);
  const void* expect_context;
};

/// Visits the boxes that the ray meets. Returns the number of visited nodes.
std::uint32_t walk_sse2(const BvhNode* nodes, const SlabNumbers& ray, const BoxVisitor& visitor);
/// Same as walk_sse2; requires AVX2 and FMA.
std::uint32_t walk_avx2(const BvhNode* nodes, const SlabNumbers& ray, const BoxVisitor& visitor);

}  // namespace minkray
