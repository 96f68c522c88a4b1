// SPDX-License-Identifier: MIT
#include "renderer/paths/wave_casts.h"

namespace minkray {

void WaveCasts::find_blocked(RayKind kind, std::span<const WorldRay> rays,
                             std::vector<std::uint8_t>& met, QueryCounts& counts) const {
  met.resize(rays.size());
  world_.occluded(rays, met, counts);
  if (!observer_) return;
  for (std::size_t i = 0; i < rays.size(); ++i)
    observer_->occluded(kind, rays[i].ray, rays[i].skip, met[i] != 0);
}

}  // namespace minkray
