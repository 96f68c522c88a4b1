// SPDX-License-Identifier: MIT
#include "renderer/render.h"

#include "renderer/camera.h"
#include "renderer/filter.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {

RenderWorld make_world(const Scene& scene, const CastOptions<Real>& options) {
  Instances<Real> instances;
  instances.reserve(instance_count(scene));
  for (const Object& object : scene.objects) instances.add(object.shape, object.pose);
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(), set.linear_alike(),
                       [&](std::size_t i) { return set.pose(i); });
  return RenderWorld(std::move(instances), options);
}

Rendering render(const Scene& scene, const RenderWorld& world, const RenderOptions& options,
                 const RenderWatch& watch, RenderJournal journal) {
  const Camera camera(scene.camera, options.resolution);
  const PixelFilter filter;
  const Integrator integrator(scene, world, options.integrator);
  const PixelRect part = options.part();
  const SampleBlocks blocks{options.samples};
  const int first_block = blocks.first_of(options.sample_share);
  const int end_block = blocks.end_of(options.sample_share);

  Rendering rendering;
  if (journal.done.empty()) {
    const Image black(part.width(), part.height());
    rendering.met.resize(black.pixels.size());
    if (options.sample_share.is_all())
      rendering.image = black;
    else
      rendering.block_sums.assign(static_cast<std::size_t>(end_block - first_block), black);
  } else {
    rendering = std::move(journal.begun);
  }

  const auto render_block = [&](int x, int y, int block, RayCounts& counts) {
    Colour sum = Colour::Zero();
    const int end = blocks.begin(block + 1);
    for (int sample = blocks.begin(block); sample < end && !watch.stopped(); ++sample) {
      Sampler sampler(options.seed, x, y, static_cast<std::uint32_t>(sample));
      const std::array<double, 2> u = sampler.next();
      const Ray<Real> ray =
          camera.ray(x + 0.5 + filter.offset(u[0]), y + 0.5 + filter.offset(u[1]));
      sum += integrator.radiance(ray, sampler, counts);
    }
    return Vec3<float>(sum.cast<float>());
  };
  const auto render_pixel = [&](int x, int y, RayCounts& counts) {
    const RayCounts before = counts;
    const int column = x - part.x0, row = y - part.y0;
    BlockTotal total;
    for (int block = first_block; block < end_block; ++block) {
      const Vec3<float> sum = render_block(x, y, block, counts);
      total.add(sum);
      if (!options.sample_share.is_all())
        rendering.block_sums[static_cast<std::size_t>(block - first_block)].at(column, row) = sum;
    }
    if (options.sample_share.is_all())
      rendering.image.at(column, row) = total.mean(options.samples);
    const std::uint64_t met =
        (counts.camera - before.camera) - (counts.background - before.background);
    rendering.met[static_cast<std::size_t>(row) * static_cast<std::size_t>(part.width()) +
                  static_cast<std::size_t>(column)] = static_cast<std::uint32_t>(met);
  };
  TileJournal tiles{std::move(journal.done), {}};
  if (journal.finished)
    tiles.finished = [&](std::size_t tile) { journal.finished(rendering, tile); };
  const auto render_tile = [&](const PixelRect& tile) {
    RayCounts counts;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) render_pixel(x, y, counts);
    return counts;
  };
  rendering.complete = for_tiles(part, rendering.counts, watch, render_tile, tiles);
  return rendering;
}

}  // namespace minkray
