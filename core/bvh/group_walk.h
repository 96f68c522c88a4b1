// SPDX-License-Identifier: MIT
// Traverses a hierarchy with rays that start at one point in similar directions, all at once.
#pragma once

#include "core/bvh/bvh.h"
#include "core/bvh/slab_ray.h"

namespace minkray {

/// Largest number of rays in a group.
inline constexpr std::size_t rays_of_group = 32;

/// Receives the boxes that rays of a group meet.
struct GroupVisitor {
  /// `rays` has a bit for each ray that meets the box. May lower numbers.t_max of any ray.
  void (*visit)(void* context, std::uint32_t box, std::uint32_t rays);
  void* context;
};

/// Visits the boxes that rays meet with 0 <= t <= t_max, near boxes first; rounding may add boxes.
/// Returns the number of visited nodes, or 0 if the rays do not form a group: they must start at
/// one point in directions whose components have the same signs, none of them nearly 0. Requires
/// AVX2 and FMA.
std::uint64_t walk_group_avx2(const BvhNode* nodes, const SlabRay* rays, std::size_t count,
                              const GroupVisitor& visitor);

}  // namespace minkray
