// SPDX-License-Identifier: MIT
#include "core/bvh/traverse.h"

namespace minkray {

std::uint32_t walk(const Bvh& bvh, const SlabNumbers& ray, const BoxVisitor& visitor,
                   InstructionSet set) {
  if (bvh.nodes.empty()) return 0;
  return set == InstructionSet::avx2 ? walk_avx2(bvh.nodes.data(), ray, visitor)
                                     : walk_sse2(bvh.nodes.data(), ray, visitor);
}

}  // namespace minkray
