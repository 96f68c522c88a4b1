// SPDX-License-Identifier: MIT
#include "renderer/paths/normals_transport.h"

namespace minkray {

void NormalsTransport::trace(std::span<TracedRay> rays, RayCounts& counts) const {
  std::vector<WorldRay> asked(rays.size());
  std::vector<WorldHit> hits(rays.size());
  counts.camera += rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i)
    asked[i] = {rays[i].ray, rays[i].left, rays[i].time, camera_rays};
  world_.closest_hits(asked, hits, counts.work);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const WorldHit& hit = hits[i];
    if (observer_) observer_->closest(RayKind::camera, rays[i].ray, rays[i].left, hit);
    rays[i].met = hit.found();
    rays[i].radiance = Colour::Ones();
    if (hit.cast.status == Status::hit)
      rays[i].radiance = 0.5 * (Colour::Ones() + hit.cast.normal.cast<double>());
    else if (hit.found())
      rays[i].radiance.setZero();
    rays[i].direct = rays[i].radiance;
    counts.background += hit.found() ? 0 : 1;
    counts.from_inside += hit.cast.status == Status::inside ? 1 : 0;
  }
}

}  // namespace minkray
