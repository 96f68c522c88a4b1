// SPDX-License-Identifier: MIT
#include "core/bvh/stream.h"

namespace minkray {

std::uint64_t walk_stream(const Bvh& bvh, std::span<SlabRay> rays, const PairVisitor& visitor,
                          InstructionSet set) {
  if (bvh.nodes.empty() || rays.empty()) return 0;
  if (set == InstructionSet::avx2)
    return walk_stream_avx2(bvh.nodes.data(), rays.data(), rays.size(), visitor);
  // Without lanes for eight boxes, taking turns saves no time.
  std::uint64_t visited = 0;
  for (std::uint32_t ray = 0; ray < rays.size(); ++ray) {
    SlabRay& slabs = rays[ray];
    visited += traverse(
        bvh, slabs,
        [&](std::uint32_t box) {
          visitor.visit(visitor.context, &ray, &box, 1);
          return slabs.numbers.t_max < 0;
        },
        ExpectNothing(), set);
  }
  return visited;
}

}  // namespace minkray
