// SPDX-License-Identifier: MIT
// The body of the walks, near boxes first. MINKRAY_WALK_KERNEL is the functions' name. Everything
// else here has the type of the lanes, and so the instruction set, in its name: see
// core/math/wide.h.
#include "core/bvh/slab_test.h"
#include "core/bvh/traverse_kernel.h"

namespace minkray {
namespace {

using Lanes = Wide<float, static_cast<int>(IsaHere::register_bytes / sizeof(float)), IsaHere>;
constexpr int lane_count = LaneOf<Lanes>::count;
using Interval = SlabInterval<Lanes>;

/// Which of a group's rays meet one of a node's boxes: the same test.
RayGroupMask rays_met(const BvhNode& node, int child, const RayGroup& group) {
  RayGroupMask met = 0;
  for (int from = 0; from < group.count; from += lane_count) {
    const Lanes t_max = Lanes::load(&group.t_max[0] + from);
    Interval t{Lanes(0.0f), t_max};
    for (int axis = 0; axis < 3; ++axis) {
      const int near = group.whole.near[axis];
      const auto lanes = [&](const auto& numbers) {
        return Lanes::load(&numbers[0][0] + axis * ray_group_capacity + from);
      };
      t.meet(Lanes(node.planes[near][axis][child]), Lanes(node.planes[1 - near][axis][child]),
             lanes(group.origin_near), lanes(group.origin_far), lanes(group.inverse_near),
             lanes(group.inverse_far));
    }
    met |= static_cast<RayGroupMask>(lane_bits(t.is_met() & (t.enter <= t_max))) << from;
  }
  return met;
}

const SlabNumbers& whole_of(const SlabNumbers& ray) {
  return ray;
}
const SlabNumbers& whole_of(const RayGroup& group) {
  return group.whole;
}
/// A single ray meets the boxes that are on its stack.
RayGroupMask rays_met(const BvhNode&, int, const SlabNumbers&) {
  return 1;
}

int patience_of(const SlabNumbers&) {
  return 1;
}
int patience_of(const RayGroup& group) {
  return group.patience;
}

template <class RayOrGroup>
Walk walk(const BvhNode* nodes, const RayOrGroup& rays, const BoxVisitor& visitor) {
  struct Waiting {
    std::uint32_t node;
    int child;
    float enter;
  };
  const SlabNumbers& whole = whole_of(rays);
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  int patience = patience_of(rays);
  Walk done;
  std::uint32_t node = 0;
  for (;;) {
    ++done.visited;
    float enters[bvh_width];
    std::uint32_t met = boxes_met<Lanes>(nodes[node], whole, whole.t_max, enters);
    // The nearest on top.
    for (const int bottom = top; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      const std::uint32_t what = nodes[node].children[child];
      if (what == BvhNode::none) break;  // rays from beyond float's range
      if (what & BvhNode::leaf) visitor.expect(visitor.expect_context, what & ~BvhNode::leaf);
      int at = top++;
      for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
      stack[at] = {node, child, enters[child]};
    }
    // The next node, and the boxes before it, if hits found meanwhile have not made them pointless.
    for (;;) {
      if (top == 0) return done;
      const Waiting& next = stack[--top];
      if (!(next.enter <= whole.t_max)) continue;
      const BvhNode& parent = nodes[next.node];
      const std::uint32_t what = parent.children[next.child];
      if (!(what & BvhNode::leaf)) {
        node = what;
        break;
      }
      const RayGroupMask meeting = rays_met(parent, next.child, rays);
      if (meeting != 0) {
        if (visitor.visit(visitor.context, what & ~BvhNode::leaf, meeting)) return done;
      } else if (--patience < 0) {
        done.complete = false;
        return done;
      }
    }
  }
}

}  // namespace

Walk MINKRAY_WALK_KERNEL(const BvhNode* nodes, const SlabNumbers& ray, const BoxVisitor& visitor) {
  return walk(nodes, ray, visitor);
}

Walk MINKRAY_WALK_KERNEL(const BvhNode* nodes, const RayGroup& group, const BoxVisitor& visitor) {
  return walk(nodes, group, visitor);
}

}  // namespace minkray
