// SPDX-License-Identifier: MIT
// A whole picture: camera rays, a shadow ray to the light and one ray of ambient occlusion from
// each point that they meet. The same code for every tracer.
#pragma once

#include "bench/image/tracer.h"
#include "renderer/image/image.h"
#include "renderer/scene/scene.h"

namespace minkray::bench {

struct Frame {
  Image image;
  std::size_t camera_rays = 0, hits = 0, shadow_rays = 0, ambient_rays = 0;

  std::size_t rays() const { return camera_rays + shadow_rays + ambient_rays; }
};

/// Runs on the threads there are. The scene needs a directional light, and gets its first.
Frame trace_frame(const Tracer& tracer, std::size_t entry, const Scene& scene,
                  const Resolution& resolution, int samples);

}  // namespace minkray::bench
