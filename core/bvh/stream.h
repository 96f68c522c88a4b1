// SPDX-License-Identifier: MIT
// Traverses a hierarchy with many incoherent rays. Several rays take turns, one node each, so that
// the processor executes their steps in parallel (docs/decisions/many-rays.md).
#pragma once

#include <span>

#include "core/bvh/traverse.h"

namespace minkray {

/// Largest number of pairs per call of PairVisitor::visit.
inline constexpr std::size_t most_pairs_at_once = 5 * std::size_t{bvh_width};

/// Receives the pairs of a ray and a box that meet. Rounding may add pairs. `visit` is a function
/// pointer rather than a template, so that kernels for different instruction sets share no code.
struct PairVisitor {
  /// May lower numbers.t_max of any ray; a negative t_max ends the ray's traversal.
  void (*visit)(void* context, const std::uint32_t* rays, const std::uint32_t* boxes,
                std::size_t pairs);
  void* context;
};

/// Visits the boxes that each ray meets with 0 <= t <= t_max, in no particular order; rounding may
/// add boxes. Returns the number of visited nodes.
std::uint64_t walk_stream(const Bvh& bvh, std::span<SlabRay> rays, const PairVisitor& visitor,
                          InstructionSet set = best_instruction_set());

/// Computes SlabRay(ray) for many rays in double, bit-identical to the constructor. The rays are
/// `stride` bytes apart. Requires AVX2 and FMA.
void make_slabs_avx2(const char* rays, std::size_t stride, std::size_t count, SlabRay* slabs);

/// Same as walk_stream; requires AVX2 and FMA.
std::uint64_t walk_stream_avx2(const BvhNode* nodes, SlabRay* rays, std::size_t count,
                               const PairVisitor& visitor);

}  // namespace minkray
