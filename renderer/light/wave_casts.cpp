// SPDX-License-Identifier: MIT
#include "renderer/light/wave_casts.h"

#include <algorithm>

namespace minkray {

/// cast(first, count) for neighbours.
template <class Cast>
void WaveCasts::in_groups(std::size_t rays, const Cast& cast) const {
  for (std::size_t first = 0; first < rays; first += group_)
    cast(first, std::min(group_, rays - first));
}

void WaveCasts::cast(std::span<const WorldRay<Real>> rays, RaysGo how,
                     std::vector<WorldHit<Real>>& hits, QueryCounts& counts) const {
  hits.resize(rays.size());
  if (how == RaysGo::each_its_way)
    world_.closest_hits_in_stream(rays, hits, counts);
  else
    in_groups(rays.size(), [&](std::size_t first, std::size_t count) {
      world_.closest_hits(rays.subspan(first, count), std::span(hits).subspan(first, count),
                          counts);
    });
}

void WaveCasts::find_blocked(RayKind kind, std::span<const WorldRay<Real>> rays, RaysGo how,
                             std::vector<std::uint8_t>& met, QueryCounts& counts) const {
  met.resize(rays.size());
  if (how == RaysGo::each_its_way)
    world_.occluded_in_stream(rays, met, counts);
  else
    in_groups(rays.size(), [&](std::size_t first, std::size_t count) {
      const RayGroupMask answers = world_.occluded(rays.subspan(first, count), counts);
      for (std::size_t k = 0; k < count; ++k) met[first + k] = answers >> k & 1;
    });
  if (!observer_) return;
  for (std::size_t i = 0; i < rays.size(); ++i)
    observer_->occluded(kind, rays[i].ray, rays[i].skip, met[i] != 0);
}

}  // namespace minkray
