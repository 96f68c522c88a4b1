// SPDX-License-Identifier: MIT
// Everything here has internal linkage or the type of the lanes in its name (core/math/wide.h).
#include "core/mesh/mesh_walk.h"

#if defined(__AVX2__)
#include "core/bvh/slab_test.h"
#include "core/mesh/triangle_lanes.h"

namespace minkray {
namespace {

using Lanes = Wide<float, 8, IsaAvx2>;

struct Waiting {
  float enter;
  std::uint32_t what;
};

/// Calls on_lanes(leaf, lanes) for the triangles that lanes cannot rule out in the leaves that the
/// ray meets, near leaves first. on_lanes may lower t_max and reach, and ends the walk by returning
/// true.
template <class OnLanes>
[[gnu::always_inline]] inline std::uint32_t walk_leaves(const MeshView& view, SlabRay& slabs,
                                                        LeafRay& ray, OnLanes&& on_lanes) {
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  std::uint32_t visited = 0, what = 0;
  for (;;) {
    if (what & BvhNode::leaf) {
      const MeshLeaf& leaf = view.leaves[what & ~BvhNode::leaf];
      fetch_indices(view, leaf);
      const std::uint32_t lanes = lanes_that_may_be_met(leaf, ray);
      if (lanes != 0 && on_lanes(leaf, lanes)) return visited;
    } else {
      ++visited;
      const BvhNode& node = view.nodes[what];
      float enters[bvh_width];
      std::uint32_t met = boxes_met<Lanes>(node, slabs.numbers, slabs.numbers.t_max, enters);
      if (met != 0) {
        const auto first = static_cast<std::uint32_t>(__builtin_ctz(met));
        met &= met - 1;
        std::uint32_t nearest = node.children[first];
        float enter = enters[first];
        if (nearest == BvhNode::none) met = 0;  // rays from beyond float's range
        fetch(view, nearest);
        for (const int bottom = top; met != 0; met &= met - 1) {
          const int child = __builtin_ctz(met);
          Waiting next = {enters[child], node.children[child]};
          if (next.what == BvhNode::none) break;
          fetch(view, next.what);
          if (next.enter < enter) {
            std::swap(next.enter, enter);
            std::swap(next.what, nearest);
          }
          int at = top++;
          for (; at > bottom && stack[at - 1].enter < next.enter; --at) stack[at] = stack[at - 1];
          stack[at] = next;
        }
        if (nearest != BvhNode::none) {
          what = nearest;
          continue;
        }
      }
    }
    do {
      if (top == 0) return visited;
      --top;
    } while (!(stack[top].enter <= slabs.numbers.t_max));
    what = stack[top].what;
  }
}

}  // namespace

PartHit closest_part_avx2(const MeshView& view, const Ray<double>& ray, double t_min,
                          PartCounts& counts) {
  SlabRay slabs;
  make_slabs_avx2(reinterpret_cast<const char*>(&ray), 0, 1, &slabs);
  const double* const numbers = reinterpret_cast<const double*>(&ray);
  LeafRay leaf_way = leaf_ray(numbers, numbers + 3, ray.t_max);
  const CastRay cast = cast_ray_of(ray, leaf_way);
  PartHit closest;
  counts.nodes +=
      walk_leaves(view, slabs, leaf_way, [&](const MeshLeaf& leaf, std::uint32_t lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
          ++counts.triangles;
          const PartHit hit = cast_in_lanes(view, leaf.triangles[__builtin_ctz(lanes)], cast);
          if (!hit.found() || !(hit.t >= t_min) || !(hit.t <= ray.t_max) ||
              !takes_place(*view.mesh, ray, closest, hit))
            continue;
          closest = hit;
          const float limit = slabs.limit(hit.t + hit.error);
          if (limit < slabs.numbers.t_max) slabs.numbers.t_max = limit;
          leaf_way.reach = (hit.t + hit.error) * leaf_way.length;
        }
        return false;
      });
  return closest;
}

bool meets_part_avx2(const MeshView& view, const Ray<double>& ray, double t_min,
                     PartCounts& counts) {
  SlabRay slabs;
  make_slabs_avx2(reinterpret_cast<const char*>(&ray), 0, 1, &slabs);
  const double* const numbers = reinterpret_cast<const double*>(&ray);
  LeafRay leaf_way = leaf_ray(numbers, numbers + 3, ray.t_max);
  const CastRay cast = cast_ray_of(ray, leaf_way);
  bool is_met = false;
  counts.nodes +=
      walk_leaves(view, slabs, leaf_way, [&](const MeshLeaf& leaf, std::uint32_t lanes) {
        for (; lanes != 0 && !is_met; lanes &= lanes - 1) {
          ++counts.triangles;
          const PartHit hit = cast_in_lanes(view, leaf.triangles[__builtin_ctz(lanes)], cast);
          is_met = hit.found() && hit.t >= t_min && hit.t <= ray.t_max &&
                   takes_place(*view.mesh, ray, {}, hit);
        }
        return is_met;
      });
  return is_met;
}

void visit_hits_avx2(const MeshView& view, const Ray<double>& ray, PartCounts& counts,
                     void (*take)(void* context, const PartHit& hit), void* context) {
  SlabRay slabs;
  make_slabs_avx2(reinterpret_cast<const char*>(&ray), 0, 1, &slabs);
  const double* const numbers = reinterpret_cast<const double*>(&ray);
  LeafRay leaf_way = leaf_ray(numbers, numbers + 3, ray.t_max);
  const CastRay cast = cast_ray_of(ray, leaf_way);
  counts.nodes +=
      walk_leaves(view, slabs, leaf_way, [&](const MeshLeaf& leaf, std::uint32_t lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
          ++counts.triangles;
          const PartHit hit = cast_in_lanes(view, leaf.triangles[__builtin_ctz(lanes)], cast);
          if (hit.found()) take(context, hit);
        }
        return false;
      });
}

}  // namespace minkray
#else
namespace minkray {

/// Never called on other machines.
PartHit closest_part_avx2(const MeshView&, const Ray<double>&, double, PartCounts&) {
  return {};
}
bool meets_part_avx2(const MeshView&, const Ray<double>&, double, PartCounts&) {
  return false;
}
void visit_hits_avx2(const MeshView&, const Ray<double>&, PartCounts&,
                     void (*)(void*, const PartHit&), void*) {}

}  // namespace minkray
#endif
