// SPDX-License-Identifier: MIT
// Body of the traversal, near boxes first. MINKRAY_WALK_KERNEL is the function's name; all other
// names here contain the instruction set (core/math/wide.h).
#include "core/bvh/slab_test.h"
#include "core/bvh/traverse_kernel.h"

namespace minkray {

std::uint32_t MINKRAY_WALK_KERNEL(const BvhNode* nodes, const SlabNumbers& ray,
                                  const BoxVisitor& visitor) {
  using Lanes = Wide<float, static_cast<int>(IsaHere::register_bytes / sizeof(float)), IsaHere>;
  struct Waiting {
    std::uint32_t what;
    float enter;
  };
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  std::uint32_t visited = 0;
  std::uint32_t node = 0;
  for (;;) {
    ++visited;
    float enters[bvh_width];
    std::uint32_t met = boxes_met<Lanes>(nodes[node], ray, ray.t_max, enters);
    // Sorts the children on the stack, the nearest on top.
    for (const int bottom = top; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      const std::uint32_t what = nodes[node].children[child];
      if (what == BvhNode::none) break;  // happens for origins outside the range of float
      if (what & BvhNode::leaf) visitor.expect(visitor.expect_context, what & ~BvhNode::leaf);
      int at = top++;
      for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
      stack[at] = {what, enters[child]};
    }
    // Visits boxes up to the next node; skips those beyond hits found in the meantime.
    for (;;) {
      if (top == 0) return visited;
      const auto [what, enter] = stack[--top];
      if (!(enter <= ray.t_max)) continue;
      if (!(what & BvhNode::leaf)) {
        node = what;
        break;
      }
      if (visitor.visit(visitor.context, what & ~BvhNode::leaf)) return visited;
    }
  }
}

}  // namespace minkray
