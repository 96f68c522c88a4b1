// SPDX-License-Identifier: MIT
#include "core/bvh/traverse.h"

namespace minkray {
WalkSet best_walk_set() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has_avx2 ? WalkSet::avx2 : WalkSet::sse2;
#else
  return WalkSet::sse2;
#endif
}

std::uint32_t walk(const Bvh& bvh, const SlabNumbers& ray, const BoxVisitor& visitor, WalkSet set) {
  if (bvh.nodes.empty()) return 0;
  return set == WalkSet::avx2 ? walk_avx2(bvh.nodes.data(), ray, visitor)
                              : walk_sse2(bvh.nodes.data(), ray, visitor);
}

}  // namespace minkray
