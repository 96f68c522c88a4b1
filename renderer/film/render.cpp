// SPDX-License-Identifier: MIT
#include "renderer/film/render.h"

#include <atomic>
#include <vector>

#include "renderer/film/camera_rays.h"
#include "renderer/film/pixel_sum.h"
#include "renderer/scene/add_instances.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Distribution of a group of rays over pixels and samples.
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
                     [](const Object& object) { return !object.movement.stands(); });
}

/// With a limit on the noise, a pixel is checked each time it has this many more samples: at the
/// same samples, however many rays go together.
constexpr int samples_between_looks = 16;

/// Samples from the first on, up to the end.
struct Pass {
  int first, end;
};

/// Each doubles what was there before, or all at once.
std::vector<Pass> passes_of(int first, int end, bool one_by_one) {
  if (!one_by_one) return {{first, end}};
  std::vector<Pass> passes;
  for (int next = 1; first < end; next = std::min(2 * next, end)) {
    passes.push_back({first, next});
    first = next;
  }
  return passes;
}

/// The mean over several threads' values; for display only, since its last digits depend on their
/// order.
class MeanNoise {
 public:
  void clear() { sum_ = 0, count_ = 0; }
  void add(double noise) {
    sum_ += noise;
    ++count_;
  }
  /// Negative if there is nothing.
  double mean() const {
    const std::uint64_t count = count_;
    return count > 0 ? sum_ / static_cast<double>(count) : -1;
  }

 private:
  std::atomic<double> sum_ = 0;
  std::atomic<std::uint64_t> count_ = 0;
};

/// Renders passes over a picture's pixels into one rendering.
class Rendered {
 public:
  Rendered(const Scene& scene, const World& world, const RenderOptions& options,
           const RenderWatch& watch, RenderJournal& journal)
      : options_(options),
        watch_(watch),
        journal_(journal),
        region_(options.region()),
        blocks_{options.samples},
        first_block_(blocks_.first_of(options.sample_share)),
        end_block_(blocks_.end_of(options.sample_share)),
        rays_(scene, world, options),
        integrator_(scene, world, options.integrator) {
    if (journal.done.empty())
      begin_black();
    else
      rendering_ = std::move(journal.begun);
  }

  Rendering run() && {
    const int first = blocks_.begin(first_block_);
    end_sample_ = blocks_.begin(end_block_);
    const std::vector<Pass> passes = passes_of(first, end_sample_, bool(journal_.passed));
    if (passes.size() > 1) kept_.resize(pixel_count(region_));
    for (const Pass& pass : passes) {
      noise_.clear();
      const bool is_last = pass.end == end_sample_;
      rendering_.complete = render(pass, is_last);
      rendering_.noise = noise_.mean();
      if (!rendering_.complete) break;
      if (!is_last) journal_.passed(rendering_, pass.end);
    }
    return std::move(rendering_);
  }

 private:
  void begin_black() {
    const Image black(region_.width(), region_.height());
    rendering_.met.resize(black.pixels.size());
    if (options_.sample_share.is_all())
      rendering_.image = black;
    else
      rendering_.block_sums.assign(static_cast<std::size_t>(end_block_ - first_block_), black);
    if (options_.light_channels) rendering_.direct = rendering_.variance = black;
  }

  /// Only the last pass finishes tiles. False if the watch stopped it.
  bool render(const Pass& pass, bool is_last) {
    // The rays of a group: samples of one pixel first, they are the closest together; then pixels.
    const int samples = pass.end - pass.first;
    const RayGroupShape group(options_.integrator.ray_group, samples);
    TileJournal tiles{journal_.done, {}};
    if (journal_.finished && is_last)
      tiles.finished = [&](std::size_t tile) { journal_.finished(rendering_, tile); };
    RenderWatch watch = watch_;
    if (watch_.progress)
      watch.progress = [&](double fraction, std::uint64_t rays) {
        const double first = blocks_.begin(first_block_);
        if (watch_.noise && noise_.mean() >= 0) watch_.noise(noise_.mean());
        watch_.progress(
            (pass.first - first + fraction * (pass.end - pass.first)) / (end_sample_ - first),
            rays);
      };
    return for_blocks(
        region_, group.pixels, rendering_.counts, watch,
        [&](const PixelBlock& pixels, RayCounts& counts) {
          render_block(pixels, pass, group.samples, counts);
        },
        tiles);
  }

  void render_block(const PixelBlock& pixels, const Pass& pass, int samples_at_once,
                    RayCounts& counts) {
    std::vector<PixelSum> sums(pixels.count());
    std::size_t place = 0;
    if (!kept_.empty() && pass.first > 0)
      pixels.for_each([&](const Pixel& pixel) { sums[place++] = kept_[pixel.index]; });
    std::vector<TracedRay> rays;  // kept: new pages for each group cost more than its rays
    int next = 0;
    for (int first = pass.first; first < pass.end && !watch_.stopped(); first = next) {
      next = std::min(first + samples_at_once, pass.end);
      if (options_.noise > 0)
        next = std::min(next, (first / samples_between_looks + 1) * samples_between_looks);
      if (!trace(pixels, {first, next}, sums.data(), rays, counts)) break;
    }
    const PixelSum* sum = sums.data();
    pixels.for_each([&](const Pixel& pixel) {
      if (!kept_.empty()) kept_[pixel.index] = *sum;
      write(pixel, *sum++, pass);
    });
  }

  /// Adds a pass of samples to each unfinished pixel; `rays` is memory. False if all are finished.
  bool trace(const PixelBlock& pixels, const Pass& part, PixelSum* sums,
             std::vector<TracedRay>& rays, RayCounts& counts) {
    rays.clear();
    rays.reserve(pixels.count() * static_cast<std::size_t>(part.end - part.first));
    const PixelSum* asked = sums;
    pixels.for_each([&](const Pixel& pixel) {
      if (asked++->is_done) return;
      for (int sample = part.first; sample < part.end; ++sample)
        rays.push_back(rays_.ray(pixel, sample));
    });
    if (rays.empty()) return false;
    integrator_.trace(rays, counts);
    const TracedRay* ray = rays.data();
    PixelSum* sum = sums;
    pixels.for_each([&](const Pixel& pixel) {
      if (!sum->is_done)
        for (int sample = part.first; sample < part.end; ++sample)
          add(pixel, *sum, sample, *ray++, sample + 1 == part.end);
      ++sum;
    });
    return true;
  }

  void add(const Pixel& pixel, PixelSum& sum, int sample, const TracedRay& ray, bool is_last) {
    sum.add(ray, options_.light_channels);
    if (is_last && options_.noise > 0 && (sample + 1) % samples_between_looks == 0)
      sum.is_done = sum.is_quiet(options_.noise);
    const int block = blocks_.of(sample);
    if (sample + 1 < blocks_.begin(block + 1) && !sum.is_done) return;
    const Vec3<float> of_block = sum.light.end_block();
    if (options_.light_channels) sum.direct.end_block();
    if (!options_.sample_share.is_all())
      rendering_.block_sums[static_cast<std::size_t>(block - first_block_)].pixels[pixel.index] =
          of_block;
  }

  /// Writes the current state of the pixel.
  void write(const Pixel& pixel, const PixelSum& sum, const Pass& pass) {
    if (sum.samples > 1) noise_.add(sum.standard_error() / sum.least_mean());
    const int samples = std::max(sum.samples, 1);
    if (options_.sample_share.is_all())
      rendering_.image.pixels[pixel.index] = sum.light.mean(samples);
    if (options_.light_channels) {
      rendering_.direct.pixels[pixel.index] = sum.direct.mean(samples);
      rendering_.variance.pixels[pixel.index] = sum.variance();
    }
    // As if it had taken all samples.
    const int all = pass.end - blocks_.begin(first_block_);
    rendering_.met[pixel.index] = static_cast<std::uint32_t>(std::int64_t{sum.met} * all / samples);
  }

  const RenderOptions& options_;
  const RenderWatch& watch_;
  RenderJournal& journal_;
  PixelRect region_;
  SampleBlocks blocks_;
  int first_block_, end_block_, end_sample_ = 0;
  CameraRays rays_;
  Integrator integrator_;
  Rendering rendering_;
  MeanNoise noise_;
  std::vector<PixelSum> kept_;  ///< between passes, if there are several
};

}  // namespace

World make_world(const Scene& scene, const CastOptions& options, BvhBuild build) {
  Instances instances;
  instances.reserve(instance_count(scene));
  for (const Object& object : scene.objects) add_object(instances, object);
  add_particles(instances, scene);
  show_instances(instances, scene);
  World world(std::move(instances), options, build);
  if (is_on_the_move(scene)) follow(world, scene);
  return world;
}

void follow(World& world, const Scene& scene) {
  const auto pose = [&](std::size_t i) { return instance_pose(scene, i); };
  if (is_on_the_move(scene))
    world.pose_all(pose, [&](std::size_t i) { return instance_movement(scene, i); });
  else
    world.pose_all(pose);
}

Rendering render(const Scene& scene, const World& world, const RenderOptions& options,
                 const RenderWatch& watch, RenderJournal journal) {
  return Rendered(scene, world, options, watch, journal).run();
}

}  // namespace minkray
