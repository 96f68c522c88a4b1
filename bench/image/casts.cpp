// SPDX-License-Identifier: MIT
#include "bench/image/casts.h"

#include <algorithm>
#include <cmath>

#include "bench/image/clock.h"
#include "bench/image/rays.h"
#include "bench/image/statistics.h"
#include "core/parallel/parallel.h"
#include "renderer/generate/random.h"

namespace minkray::bench {
namespace {

/// Direction of a distant light: approximately that of `minkray generate`'s scenes.
const Vec3<float> towards_light = Vec3<float>(0.3f, -1, 1.4f).normalized();

/// A batch has as many rays as a tile has.
constexpr std::size_t batch_size = tile_side * tile_side;

/// Rays in batches, each with a queue that they are prepared in.
class Race {
 public:
  Race(const Tracer& tracer, std::size_t entry, std::string name) : name_(std::move(name)) {
    entry_ = tracer.entries()[entry];
    make_queue_ = [&tracer, entry] { return tracer.queue(entry); };
  }

  /// The seconds of one round; the answers stay.
  double run(std::span<const Ray<float>> rays, RayKindAsked kind) {
    const std::size_t batches = (rays.size() + batch_size - 1) / batch_size;
    while (queues_.size() < batches) queues_.push_back(make_queue_());
    const auto batch = [&](auto all, std::size_t i) {
      return all.subspan(i * batch_size, std::min(batch_size, all.size() - i * batch_size));
    };
    hits_.resize(rays.size());
    const bool coherent = kind == RayKindAsked::camera || kind == RayKindAsked::light_shadows;
    for (std::size_t i = 0; i < batches; ++i) queues_[i]->prepare({batch(rays, i), {}, coherent});
    if (kind == RayKindAsked::camera || kind == RayKindAsked::scattered) {
      const Clock clock;
      for (std::size_t i = 0; i < batches; ++i)
        queues_[i]->first_hits(batch(std::span<FirstHit>(hits_), i));
      return clock.processor_seconds();
    }
    dark_.resize(rays.size());
    const Clock clock;
    for (std::size_t i = 0; i < batches; ++i)
      queues_[i]->occluded(batch(std::span<unsigned char>(dark_), i));
    const double seconds = clock.processor_seconds();
    for (std::size_t i = 0; i < dark_.size(); ++i)
      hits_[i] = dark_[i] ? FirstHit{0, 0, Vec3<float>::Zero()} : FirstHit{};
    return seconds;
  }

  const std::string& name() const { return name_; }
  const std::string& entry() const { return entry_; }
  std::span<const FirstHit> hits() const { return hits_; }
  std::vector<double> times;

 private:
  std::string name_, entry_;
  std::function<std::unique_ptr<RayQueue>()> make_queue_;
  std::vector<std::unique_ptr<RayQueue>> queues_;
  std::vector<FirstHit> hits_;
  std::vector<unsigned char> dark_;
};

CastResults results_of(const std::vector<Race>& races, std::size_t rays) {
  CastResults results;
  results.count = rays;
  const Race* best = nullptr;
  for (const Race& race : races)
    if (race.name() == ours && (!best || median(race.times) < median(best->times))) best = &race;
  for (const Race& race : races) {
    CastSpeed speed;
    speed.contender = race.name();
    speed.entry = race.entry();
    speed.nanoseconds = median(race.times) / static_cast<double>(rays) * 1e9;
    std::vector<double> ratios;
    for (std::size_t round = 0; round < race.times.size(); ++round)
      ratios.push_back(race.times[round] / best->times[round]);
    speed.ratio = median(ratios);
    speed.agreement = compare(best->hits(), race.hits());
    results.speeds.push_back(std::move(speed));
  }
  results.hit_rate =
      static_cast<double>(results.speeds.front().agreement.hits) / static_cast<double>(rays);
  return results;
}

/// Camera rays of a square picture of about this many pixels.
std::vector<Ray<float>> coherent_rays(const Scene& scene, std::size_t count) {
  const int side = std::max(
      tile_side, static_cast<int>(std::sqrt(static_cast<double>(count))) / tile_side * tile_side);
  const Resolution resolution{side, side};
  const Camera camera(scene.camera, resolution);
  std::vector<Ray<float>> rays, of_tile;
  std::vector<std::array<int, 2>> pixels;
  for (const PixelRect& tile : tiles_of(resolution)) {
    camera_rays(camera, tile, 1, of_tile, pixels);
    rays.insert(rays.end(), of_tile.begin(), of_tile.end());
  }
  return rays;
}

}  // namespace

double CastResults::best_ratio(std::string_view contender) const {
  double best = std::numeric_limits<double>::infinity();
  for (const CastSpeed& speed : speeds)
    if (std::string_view(speed.contender).starts_with(contender))
      best = std::min(best, speed.ratio);
  return best;
}

std::vector<CastResults> measure_casts(const Subject& subject,
                                       const std::vector<Contender>& contenders,
                                       std::size_t ray_count, int rounds, bool with_shadows) {
  std::vector<CastResults> all;
  with_threads(1, [&] {
    std::vector<std::unique_ptr<Tracer>> tracers;
    for (const Contender& contender : contenders)
      tracers.push_back(contender.make(subject.scene, 1));
    const auto race = [&](const std::string& label, std::span<const Ray<float>> rays,
                          RayKindAsked kind) {
      std::vector<Race> races;
      for (std::size_t c = 0; c < tracers.size(); ++c)
        for (std::size_t entry = 0; entry < tracers[c]->entries().size(); ++entry)
          races.emplace_back(*tracers[c], entry, contenders[c].name);
      for (Race& one : races) one.run(rays, kind);  // warms the caches
      for (int round = 0; round < rounds; ++round)
        for (Race& one : races) one.times.push_back(one.run(rays, kind));
      all.push_back(results_of(races, rays.size()));
      all.back().rays = label;
      all.back().kind = kind;
      return std::vector<FirstHit>(races.front().hits().begin(), races.front().hits().end());
    };

    const std::vector<Ray<float>> camera = coherent_rays(subject.scene, ray_count);
    const std::vector<FirstHit> hits = race("coherent camera rays", camera, RayKindAsked::camera);
    SecondaryRays scattered;
    secondary_rays(*tracers.front(), camera, hits, lift_for(subject.scene), std::nullopt, 0,
                   scattered);
    Random random(1);
    for (std::size_t i = scattered.rays.size(); i > 1; --i)
      std::swap(scattered.rays[i - 1], scattered.rays[random.bits() % i]);
    if (scattered.rays.empty()) return;
    race("incoherent scattered rays", scattered.rays, RayKindAsked::scattered);
    if (!with_shadows) return;
    race("occlusion of scattered rays", scattered.rays, RayKindAsked::scattered_shadows);
    SecondaryRays to_light;
    secondary_rays(*tracers.front(), camera, hits, lift_for(subject.scene),
                   Vec3<float>(towards_light), 0, to_light);
    if (!to_light.rays.empty())
      race("occlusion towards a light", to_light.rays, RayKindAsked::light_shadows);
  });
  return all;
}

}  // namespace minkray::bench
