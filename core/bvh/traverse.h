// SPDX-License-Identifier: MIT
// Walking a ray through a bounding volume hierarchy, near boxes first.
#pragma once

#include <array>
#include <utility>

#include "core/bvh/bvh.h"
#include "core/math/slab_test.h"

namespace minkray {

/// Calls on_primitive(index, t_max) for the primitives whose leaf's box the ray meets with
/// 0 <= t <= t_max. It may lower t_max, and ends the walk by returning true. Answers how many
/// nodes' boxes were tested.
template <class T, class OnPrimitive>
std::uint32_t traverse(const Bvh& bvh, const Ray<T>& ray, OnPrimitive&& on_primitive) {
  constexpr T never = std::numeric_limits<T>::infinity();
  struct Waiting {
    std::uint32_t node;
    T enter;
  };
  if (bvh.nodes.empty()) return 0;

  const SlabRay<T> slabs(ray);
  T t_max = ray.t_max;
  std::array<Waiting, bvh_max_depth> stack;
  std::size_t waiting = 0;
  std::uint32_t tested = 1;
  // Infinity means "no" here, so a ray that enters a box at infinity is not one: t is finite.
  Waiting now{0, slab_entry(slabs, bvh.nodes[0].planes, t_max)};
  if (now.enter == never) return tested;

  for (;;) {
    const BvhNode& node = bvh.nodes[now.node];
    if (node.is_leaf()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (on_primitive(bvh.primitives[i], t_max)) return tested;
    } else {
      const std::uint32_t left = node.first, right = left + 1;
      Waiting near{left, slab_entry(slabs, bvh.nodes[left].planes, t_max)};
      Waiting far{right, slab_entry(slabs, bvh.nodes[right].planes, t_max)};
      tested += 2;
      if (far.enter < near.enter) std::swap(near, far);
      if (near.enter != never) {
        if (far.enter != never) stack[waiting++] = far;
        now = near;
        continue;
      }
    }
    // The nearest box still waiting, if the hits found meanwhile have not made it pointless.
    do {
      if (waiting == 0) return tested;
      now = stack[--waiting];
    } while (!(now.enter <= t_max * slab_padding<T>));
  }
}

}  // namespace minkray
