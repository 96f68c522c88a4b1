// SPDX-License-Identifier: MIT
#include "core/bvh/ray_group.h"

namespace minkray {

#if defined(__AVX2__)
std::uint64_t walk_group_avx2(const BvhNode* nodes, const SlabRay* rays, std::size_t count,
                              const GroupVisitor& visitor) {
  RayGroup group;
  if (!group.take(rays, count)) return 0;
  return group.walk(
      nodes,
      [&](std::uint32_t box, std::uint32_t in) {
        visitor.visit(visitor.context, box, in);
        bool is_lower = false;
        for (; in != 0; in &= in - 1) {
          const auto i = static_cast<std::size_t>(__builtin_ctz(in));
          is_lower |= group.lower(i, rays[i].numbers.t_max);
        }
        return is_lower;
      },
      [](std::uint32_t) {});
}
#else
/// Never called on other machines.
std::uint64_t walk_group_avx2(const BvhNode*, const SlabRay*, std::size_t, const GroupVisitor&) {
  return 0;
}
#endif

}  // namespace minkray
