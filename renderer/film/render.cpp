// SPDX-License-Identifier: MIT
#include "renderer/film/render.h"

#include <array>
#include <cmath>

#include "renderer/film/pixel_loop.h"
#include "renderer/image/filter.h"
#include "renderer/light/camera.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// How so many rays are taken from pixels and samples.
struct RayGroupShape {
  int samples;
  BlockSize pixels;

  RayGroupShape(int rays, int samples_of_pixel) : samples(std::clamp(samples_of_pixel, 1, rays)) {
    while (2 * samples * pixels.width * pixels.height <= rays && pixels.width < tile_size)
      (pixels.height < pixels.width ? pixels.height : pixels.width) *= 2;
  }
};

/// While the shutter is open.
bool is_on_the_move(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& object) { return !object.shift.isZero(0); });
}

/// With a limit to the noise a pixel is looked at after so many samples, and again and again: at
/// the same samples however many rays go together.
constexpr int samples_between_looks = 16;

/// What is darker than this counts as noisy as this: a part of white.
constexpr double least_brightness = 0.02;

/// A pixel while its samples come in, in their order: the same additions however many come at once.
struct PixelSum {
  Colour block = Colour::Zero();
  BlockTotal total;
  std::uint32_t met = 0;
  int samples = 0;
  bool is_done = false;
  double mean = 0, deviations = 0;  ///< of the brightness (Welford 1962)

  void add(const TracedRay& ray) {
    block += ray.radiance;
    met += ray.met ? 1 : 0;
    ++samples;
    const double brightness = ray.radiance.mean(), off = brightness - mean;
    mean += off / samples;
    deviations += off * (brightness - mean);
  }
  /// Whether the standard error of its mean is small enough.
  bool is_quiet(double noise) const {
    const double n = samples;
    return std::sqrt(deviations / (n * (n - 1))) <= noise * std::max(mean, least_brightness);
  }
  Vec3<float> end_block() {
    const Vec3<float> sum(block.cast<float>());
    block.setZero();
    total.add(sum);
    return sum;
  }
};

}  // namespace

RenderWorld make_world(const Scene& scene, const CastOptions<Real>& options, BvhBuild build) {
  Instances<Real> instances;
  instances.reserve(instance_count(scene));
  for (const Object& object : scene.objects) {
    if (object.half_space)
      instances.add(*object.half_space, object.pose);
    else
      instances.add(object.shape, object.pose);
  }
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(), set.linear_alike(),
                       [&](std::size_t i) { return set.pose(i); });
  RenderWorld world(std::move(instances), options, build);
  if (is_on_the_move(scene)) follow(world, scene);
  return world;
}

void follow(RenderWorld& world, const Scene& scene) {
  const auto pose = [&](std::size_t i) { return instance_pose(scene, i); };
  if (is_on_the_move(scene))
    world.pose_all(pose, [&](std::size_t i) { return instance_shift(scene, i); });
  else
    world.pose_all(pose);
}

Rendering render(const Scene& scene, const RenderWorld& world, const RenderOptions& options,
                 const RenderWatch& watch, RenderJournal journal) {
  const Camera camera(scene.camera, options.resolution);
  const PixelFilter filter;
  const Integrator integrator(scene, world, options.integrator);
  const PixelRect region = options.region();
  const SampleBlocks blocks{options.samples};
  const int first_block = blocks.first_of(options.sample_share);
  const int end_block = blocks.end_of(options.sample_share);

  Rendering rendering;
  if (journal.done.empty()) {
    const Image black(region.width(), region.height());
    rendering.met.resize(black.pixels.size());
    if (options.sample_share.is_all())
      rendering.image = black;
    else
      rendering.block_sums.assign(static_cast<std::size_t>(end_block - first_block), black);
  } else {
    rendering = std::move(journal.begun);
  }

  // The rays of a group: samples of one pixel first, they are the closest together; then pixels.
  const RayGroupShape group(options.integrator.ray_group,
                            blocks.begin(end_block) - blocks.begin(first_block));
  // When nothing moves no random numbers are spent on when.
  const bool blurs = world.instances().move();
  const int begin_sample = blocks.begin(first_block), end_sample = blocks.begin(end_block);
  const auto render_block = [&](const PixelBlock& pixels, RayCounts& counts) {
    std::array<PixelSum, most_in_ray_group> sums;
    std::array<TracedRay, most_in_ray_group> rays;
    const int end = blocks.begin(end_block);
    int next = 0;
    for (int first = blocks.begin(first_block); first < end && !watch.stopped(); first = next) {
      next = std::min(first + group.samples, end);
      if (options.noise > 0)
        next = std::min(next, (first / samples_between_looks + 1) * samples_between_looks);
      std::size_t count = 0;
      const PixelSum* asked = sums.data();
      pixels.for_each([&](const Pixel& pixel) {
        if (asked++->is_done) return;
        for (int sample = first; sample < next; ++sample) {
          TracedRay& ray = rays[count++];
          ray.sampler = Sampler(options.seed, pixel.x, pixel.y, static_cast<std::uint32_t>(sample));
          const std::array<double, 2> u = ray.sampler.next();
          ray.ray =
              camera.ray(pixel.x + 0.5 + filter.offset(u[0]), pixel.y + 0.5 + filter.offset(u[1]));
          if (camera.has_lens()) ray.ray = camera.through_lens(ray.ray, ray.sampler.next());
          ray.time = blurs ? ray.sampler.next()[0] : 0;
        }
      });
      if (count == 0) break;
      integrator.trace(std::span(rays).first(count), counts);
      const TracedRay* ray = rays.data();
      PixelSum* sum = sums.data();
      pixels.for_each([&](const Pixel& pixel) {
        if (sum->is_done) {
          ++sum;
          return;
        }
        const bool is_looked_at = options.noise > 0 && next % samples_between_looks == 0;
        for (int sample = first; sample < next; ++sample) {
          sum->add(*ray++);
          if (is_looked_at && sample + 1 == next) sum->is_done = sum->is_quiet(options.noise);
          const int block = blocks.of(sample);
          if (sample + 1 < blocks.begin(block + 1) && !sum->is_done) continue;
          const Vec3<float> of_block = sum->end_block();
          if (!options.sample_share.is_all())
            rendering.block_sums[static_cast<std::size_t>(block - first_block)]
                .pixels[pixel.index] = of_block;
        }
        ++sum;
      });
    }
    const PixelSum* sum = sums.data();
    pixels.for_each([&](const Pixel& pixel) {
      if (options.sample_share.is_all())
        rendering.image.pixels[pixel.index] = sum->total.mean(std::max(sum->samples, 1));
      // As if it had taken all samples.
      rendering.met[pixel.index] =
          sum->samples == 0
              ? 0
              : static_cast<std::uint32_t>(std::int64_t{sum->met} * (end_sample - begin_sample) /
                                           sum->samples);
      ++sum;
    });
  };
  TileJournal tiles{std::move(journal.done), {}};
  if (journal.finished)
    tiles.finished = [&](std::size_t tile) { journal.finished(rendering, tile); };
  rendering.complete =
      for_blocks(region, group.pixels, rendering.counts, watch, render_block, tiles);
  return rendering;
}

}  // namespace minkray
