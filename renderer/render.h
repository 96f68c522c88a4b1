// SPDX-License-Identifier: MIT
// Whole pictures: tiles on all cores, each pixel by itself, so that the picture is equal bit for
// bit for any number of threads and any crop.
#pragma once

#include "renderer/image.h"
#include "renderer/integrator.h"
#include "renderer/tiles.h"

namespace minkray {

/// The scene's objects, in order.
RenderWorld make_world(const Scene& scene, const CastOptions<Real>& options = {});

struct RenderOptions {
  Resolution resolution;
  PixelRect crop;  ///< the part to render; empty: all
  int samples = 16;
  std::uint64_t seed = 0;
  IntegratorOptions integrator;

  PixelRect part() const {
    return crop.empty() ? PixelRect{0, 0, resolution.width, resolution.height} : crop;
  }
};

struct Rendering {
  Image image;  ///< linear radiance, of the part asked for
  RayCounts counts;
  bool complete = false;  ///< false if the watch said stop
};

/// Refers to `world` made of `scene`.
Rendering render(const Scene& scene, const RenderWorld& world, const RenderOptions& options,
                 const RenderWatch& watch = {});

}  // namespace minkray
