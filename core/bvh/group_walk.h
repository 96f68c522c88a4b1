// SPDX-License-Identifier: MIT
// Traverses a hierarchy with rays that start at one point in similar directions, all at once.
#pragma once

#include <span>

#include "core/bvh/bvh.h"
#include "core/bvh/slab_ray.h"

namespace minkray {

/// Largest number of rays in a group, and the least number for which a group is faster than single
/// rays.
inline constexpr std::size_t rays_of_group = 32, least_rays_of_group = 12;

/// True if the rays have the same origin, and directions that differ by at most `most`, relative to
/// the first one. A quick test of the first and the last of many rays.
inline bool are_alike(const Ray<double>& first, const Ray<double>& last, double most) {
  if (first.origin != last.origin) return false;
  const double size = first.direction.cwiseAbs().maxCoeff();
  return (last.direction - first.direction).cwiseAbs().maxCoeff() <= most * size;
}

/// True if the rays between the first and the last one may form a group.
inline bool may_form_group(const Ray<double>& first, const Ray<double>& last) {
  return are_alike(first, last, 0.25);
}

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

/// Same, calling on_box(box, rays).
template <class OnBox>
std::uint64_t walk_group(const Bvh& bvh, std::span<const SlabRay> rays, OnBox& on_box) {
  const auto visit = [](void* context, std::uint32_t box, std::uint32_t in) {
    (*static_cast<OnBox*>(context))(box, in);
  };
  return walk_group_avx2(bvh.nodes.data(), rays.data(), rays.size(), {visit, &on_box});
}

}  // namespace minkray
