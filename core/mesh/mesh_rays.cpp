// SPDX-License-Identifier: MIT
#include "core/mesh/mesh_rays.h"

#include <algorithm>

#include "core/mesh/mesh_walk.h"

namespace minkray {
namespace {

/// Fewer rays are faster one by one.
constexpr std::size_t least_many = 4;

/// Calls many(from, count) for rays that suit lanes, one(i) for the others.
template <class Many, class One>
void split_by_suitability(const TriangleMesh& mesh, std::span<const PartRay> rays, const Many& many,
                          const One& one) {
  const bool may_be_many = has_lanes(mesh);
  for (std::size_t from = 0; from < rays.size();) {
    std::size_t end = from;
    while (may_be_many && end < rays.size() && end - from < most_rays_of_walk &&
           suits_lanes(rays[end].ray))
      ++end;
    if (end - from >= least_many) {
      many(from, end - from);
      from = end;
    }
    for (; from < std::max(end, std::min(from + 1, rays.size())); ++from) one(from);
  }
}

/// After a group whose rays meet different leaves, this many groups skip the group test and go to
/// streams.
constexpr std::size_t groups_passed_over = 7;

/// Casts groups of neighbours with similar directions, and streams of the rays between them.
void closest_of_many(const MeshView& view, const PartRay* rays, std::size_t count, PartHit* hits,
                     PartCounts& counts) {
  std::size_t waiting = 0, passed_over = 0;
  const auto stream_up_to = [&](std::size_t end) {
    if (waiting < end)
      closest_parts_avx2(view, rays + waiting, end - waiting, hits + waiting, counts);
    waiting = end;
  };
  for (std::size_t from = 0; from < count; from += rays_of_group) {
    const std::size_t in_group = std::min(rays_of_group, count - from);
    if (passed_over > 0) {
      --passed_over;
      continue;
    }
    if (in_group < least_rays_of_group ||
        !may_form_group(rays[from].ray, rays[from + in_group - 1].ray))
      continue;
    const GroupResult result =
        closest_parts_of_group_avx2(view, rays + from, in_group, hits + from, counts);
    if (result == GroupResult::none) continue;
    if (result == GroupResult::scattered) passed_over = groups_passed_over;
    stream_up_to(from);
    waiting = from + in_group;
  }
  stream_up_to(count);
}

}  // namespace

void closest_parts(const TriangleMesh& mesh, std::span<const PartRay> rays, std::span<PartHit> hits,
                   PartCounts& counts) {
  split_by_suitability(
      mesh, rays,
      [&](std::size_t from, std::size_t count) {
        closest_of_many(view_of(mesh), &rays[from], count, &hits[from], counts);
      },
      [&](std::size_t i) { hits[i] = closest_part(mesh, rays[i].ray, rays[i].t_min, counts); });
}

void meet_parts(const TriangleMesh& mesh, std::span<const PartRay> rays,
                std::span<std::uint8_t> met, PartCounts& counts) {
  split_by_suitability(
      mesh, rays,
      [&](std::size_t from, std::size_t count) {
        meet_parts_avx2(view_of(mesh), &rays[from], count, &met[from], counts);
      },
      [&](std::size_t i) {
        met[i] = meets_part(mesh, rays[i].ray, rays[i].t_min, counts) ? 1 : 0;
      });
}

}  // namespace minkray
