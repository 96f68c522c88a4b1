// SPDX-License-Identifier: MIT
// Traverses a bounding volume hierarchy with a ray, near boxes first.
#pragma once

#include <type_traits>

#include "core/bvh/bvh.h"
#include "core/bvh/slab_ray.h"
#include "core/bvh/traverse_kernel.h"
#include "core/math/instruction_set.h"

namespace minkray {

/// Traversals of all instruction sets find the same boxes.
std::uint32_t walk(const Bvh& bvh, const SlabNumbers& ray, const BoxVisitor& visitor,
                   InstructionSet set = best_instruction_set());

/// Prefetches nothing: for boxes whose contents are in the cache anyway.
struct ExpectNothing {
  void operator()(std::uint32_t) const {}
};

/// Wraps on_expected(box) as a plain function, for BoxVisitor.
template <class OnExpected>
void expected(const void* context, std::uint32_t box) {
  (*static_cast<const OnExpected*>(context))(box);
}

/// Calls on_box(index) for the boxes that the ray meets with 0 <= t <= t_max; rounding may add
/// boxes. on_box may lower ray.numbers.t_max, and ends the traversal by returning true. Calls
/// on_expected(index) in advance for boxes that may be visited soon. Returns the number of visited
/// nodes.
template <class OnBox, class OnExpected = ExpectNothing>
std::uint32_t traverse(const Bvh& bvh, const SlabRay& ray, OnBox&& on_box,
                       const OnExpected& on_expected = {},
                       InstructionSet set = best_instruction_set()) {
  using Function = std::remove_reference_t<OnBox>;
  const auto visit = [](void* context, std::uint32_t box) -> bool {
    return (*static_cast<Function*>(context))(box);
  };
  return walk(bvh, ray.numbers, {visit, &on_box, expected<OnExpected>, &on_expected}, set);
}

}  // namespace minkray
