// SPDX-License-Identifier: MIT
#include "renderer/film/features.h"

#include "renderer/film/camera_rays.h"
#include "renderer/surfaces/scene_surfaces.h"

namespace minkray {
namespace {

/// More rays add nothing to a pixel's features.
constexpr int most_rays = 16;

}  // namespace

NoisyPicture noisy_picture(const Scene& scene, const World& world, const RenderOptions& options,
                           const Rendering& rendering, const RenderWatch& watch) {
  NoisyPicture picture{rendering.image, rendering.variance, rendering.image, rendering.image,
                       std::vector<float>(rendering.image.pixels.size())};
  const CameraRays rays(scene, world, options);
  const SceneSurfaces surfaces(scene);
  const int count = std::min(options.samples, most_rays);
  RayCounts counts;
  for_pixels(options.region(), counts, watch, [&](const Pixel& pixel, RayCounts& of_tile) {
    Colour albedo = Colour::Zero(), emission = Colour::Zero(), albedos = Colour::Zero();
    Vec3<double> normals = Vec3<double>::Zero();
    double depths = 0;
    int met = 0;
    for (int sample = 0; sample < count; ++sample) {
      const TracedRay ray = rays.ray(pixel, sample);
      const WorldHit hit =
          world.closest_hit({ray.ray, ray.left, ray.time, camera_rays}, of_tile.work);
      ++of_tile.camera;
      if (hit.cast.status != Status::hit) continue;
      surfaces.describe(world, ray.ray, ray.cone, hit, albedo, emission);
      albedos += albedo;
      normals += surfaces.looks()
                     .smooth(world, surface_hit(hit), ray.ray.at(hit.cast.t()), ray.time)
                     .normal;
      depths += hit.cast.t();
      ++met;
    }
    picture.albedo.pixels[pixel.index] = (albedos / count).cast<float>();
    picture.normal.pixels[pixel.index] = (normals / count).cast<float>();
    picture.depth[pixel.index] =
        met > 0 ? static_cast<float>(depths / met) : std::numeric_limits<float>::infinity();
  });
  return picture;
}

}  // namespace minkray
