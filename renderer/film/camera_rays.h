// SPDX-License-Identifier: MIT
// Camera rays of a picture's samples: position in the pixel and on the lens, and time. A sample of
// a pixel always has the same ray.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/film/pixel_loop.h"
#include "renderer/film/render.h"
#include "renderer/image/filter.h"
#include "renderer/rays/camera.h"

namespace minkray {

class CameraRays {
 public:
  CameraRays(const Scene& scene, const World& world, const RenderOptions& options)
      : camera_(scene.camera, options.resolution),
        seed_(options.seed),
        blurs_(world.instances().move()),
        of_samples_(is_painted(scene) ? 1 / std::sqrt(options.samples) : 0) {}

  /// The ray's sampler continues after the numbers used for the ray.
  TracedRay ray(const Pixel& pixel, int sample) const {
    TracedRay traced;
    traced.sampler = Sampler(seed_, pixel.x, pixel.y, static_cast<std::uint32_t>(sample));
    const std::array<double, 2> u = traced.sampler.next();
    traced.ray =
        camera_.ray(pixel.x + 0.5 + filter_.offset(u[0]), pixel.y + 0.5 + filter_.offset(u[1]));
    if (of_samples_ > 0) traced.cone = camera_.cone(pixel.x + 0.5, pixel.y + 0.5).part(of_samples_);
    if (camera_.has_lens()) traced.ray = camera_.through_lens(traced.ray, traced.sampler.next());
    // When nothing moves no random numbers are spent on when.
    traced.time = blurs_ ? traced.sampler.next()[0] : 0;
    return traced;
  }

 private:
  static bool is_painted(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return minkray::is_painted(material); });
  }

  Camera camera_;
  PixelFilter filter_;
  std::uint64_t seed_;
  bool blurs_;
  double of_samples_;  ///< the width of one of a pixel's samples, if that matters
};

}  // namespace minkray
