// SPDX-License-Identifier: MIT
#include "bench/image/frame.h"

#include <mutex>

#include "bench/image/rays.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {
namespace {

/// The light is this much brighter than the sky.
constexpr float light_strength = 1.5f, sky_strength = 0.6f;

/// Data of one thread for a tile.
struct Workshop {
  std::vector<Ray<float>> rays;
  std::vector<std::array<int, 2>> pixel_of;
  std::vector<FirstHit> hits;
  SecondaryRays secondary;
  std::vector<unsigned char> dark;
};

Vec3<float> towards_light(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (const auto* directional = std::get_if<DirectionalLight>(&light))
      return (-directional->direction).normalized().cast<float>();
  return Vec3<float>::UnitZ();
}

}  // namespace

Frame trace_frame(const Tracer& tracer, std::size_t entry, const Scene& scene,
                  const Resolution& resolution, int samples) {
  const Camera camera(scene.camera, resolution);
  const Vec3<float> light = towards_light(scene);
  const float lift = lift_for(scene);
  const std::vector<PixelRect> tiles = tiles_of(resolution);
  Frame frame;
  frame.image = Image(resolution.width, resolution.height);
  std::mutex mutex;

  const auto render_tile = [&](const PixelRect& tile, RayQueue& queue, Workshop& w) {
    Frame counts;
    const auto add = [&](std::size_t ray, const Vec3<float>& light_arrived) {
      frame.image.at(w.pixel_of[ray][0], w.pixel_of[ray][1]) +=
          light_arrived / static_cast<float>(samples);
    };
    camera_rays(camera, tile, samples, w.rays, w.pixel_of);
    w.hits.resize(w.rays.size());
    queue.prepare({w.rays, {}, true});
    queue.first_hits(w.hits);
    counts.camera_rays = w.rays.size();
    for (std::size_t i = 0; i < w.hits.size(); ++i) {
      if (w.hits[i].found())
        ++counts.hits;
      else
        add(i, scene.background.zenith.cast<float>());
    }

    const auto light_from = [&](const std::optional<Vec3<float>>& towards, bool coherent) {
      const auto seed =
          static_cast<std::uint64_t>(tile.y0) << 32 | static_cast<std::uint64_t>(tile.x0);
      secondary_rays(tracer, w.rays, w.hits, lift, towards, seed, w.secondary);
      if (w.secondary.rays.empty()) return;
      w.dark.resize(w.secondary.rays.size());
      queue.prepare({w.secondary.rays, w.secondary.leaves, coherent});
      queue.occluded(w.dark);
      for (std::size_t i = 0; i < w.dark.size(); ++i) {
        if (w.dark[i]) continue;
        const std::size_t ray = w.secondary.from[i];
        const float strength = towards
                                   ? light_strength * tracer.world_normal(w.hits[ray]).dot(*towards)
                                   : sky_strength;
        add(ray, Vec3<float>::Constant(0.7f * strength));
      }
    };
    light_from(light, true);
    counts.shadow_rays = w.secondary.rays.size();
    light_from(std::nullopt, false);
    counts.ambient_rays = w.secondary.rays.size();

    const std::lock_guard lock(mutex);
    frame.camera_rays += counts.camera_rays;
    frame.hits += counts.hits;
    frame.shadow_rays += counts.shadow_rays;
    frame.ambient_rays += counts.ambient_rays;
  };

  // A few tiles at a time, so that queues are made seldom.
  parallel_for(tiles.size(), 8, [&](std::size_t begin, std::size_t end) {
    const std::unique_ptr<RayQueue> queue = tracer.queue(entry);
    Workshop workshop;
    for (std::size_t i = begin; i < end; ++i) render_tile(tiles[i], *queue, workshop);
  });
  return frame;
}

}  // namespace minkray::bench
