// SPDX-License-Identifier: MIT
#include "core/bvh/traverse.h"

namespace minkray {
namespace {

template <class RayOrGroup>
Walk walk_with(const Bvh& bvh, const RayOrGroup& rays, const BoxVisitor& visitor, WalkSet set) {
  if (bvh.nodes.empty()) return {};
  return set == WalkSet::avx2 ? walk_avx2(bvh.nodes.data(), rays, visitor)
                              : walk_sse2(bvh.nodes.data(), rays, visitor);
}

}  // namespace

WalkSet best_walk_set() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has_avx2 ? WalkSet::avx2 : WalkSet::sse2;
#else
  return WalkSet::sse2;
#endif
}

Walk walk(const Bvh& bvh, const SlabNumbers& ray, const BoxVisitor& visitor, WalkSet set) {
  return walk_with(bvh, ray, visitor, set);
}

Walk walk(const Bvh& bvh, const RayGroup& group, const BoxVisitor& visitor, WalkSet set) {
  return walk_with(bvh, group, visitor, set);
}

}  // namespace minkray
