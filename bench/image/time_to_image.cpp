// SPDX-License-Identifier: MIT
#include "bench/image/time_to_image.h"

#include <malloc.h>

#include "bench/image/clock.h"
#include "bench/image/statistics.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {
namespace {

std::size_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Times of the rounds of one contender.
struct Rounds {
  std::vector<double> build, hierarchy, trace, image;
  ImageTime last;
  std::size_t entry = 0;
  bool entry_known = false;
  Image picture;
};

/// The entry that is fastest for a small picture of the scene.
std::size_t best_entry(const Tracer& tracer, const Scene& scene, int threads) {
  const std::size_t entries = tracer.entries().size();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t entry = 0; entry < entries && entries > 1; ++entry) {
    const Clock clock;
    trace_frame(tracer, entry, scene, {256, 192}, 1);
    const double seconds = clock.seconds_on(threads);
    if (seconds < least) best = entry;
    least = std::min(least, seconds);
  }
  return best;
}

void run_round(const Contender& contender, const Subject& subject, const ImageOptions& options,
               Rounds& rounds) {
  const std::size_t heap_before = heap_bytes();
  const Clock building;
  const std::unique_ptr<Tracer> tracer = contender.make(subject.scene, options.threads);
  const double build = building.seconds_on(options.threads);
  rounds.last.heap_bytes = heap_bytes() - heap_before;
  rounds.last.bytes = tracer->bytes();
  if (!rounds.entry_known) rounds.entry = best_entry(*tracer, subject.scene, options.threads);
  rounds.entry_known = true;
  rounds.last.entry = tracer->entries()[rounds.entry];
  const Clock tracing;
  Frame frame =
      trace_frame(*tracer, rounds.entry, subject.scene, options.resolution, options.samples);
  const double trace = tracing.seconds_on(options.threads);
  rounds.last.rays = frame.rays();
  rounds.picture = std::move(frame.image);
  rounds.build.push_back(build);
  rounds.hierarchy.push_back(tracer->hierarchy_seconds());
  rounds.trace.push_back(trace);
  rounds.image.push_back(build + trace);
}

double ratio_of(const std::vector<double>& theirs, const std::vector<double>& of_ours) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < theirs.size(); ++i) ratios.push_back(theirs[i] / of_ours[i]);
  return median(ratios);
}

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += static_cast<double>((a.pixels[i] - b.pixels[i]).cwiseAbs().mean());
  return sum / static_cast<double>(a.pixels.size());
}

}  // namespace

std::vector<ImageTime> measure_images(const Subject& subject,
                                      const std::vector<Contender>& contenders,
                                      const ImageOptions& options) {
  std::vector<Rounds> all(contenders.size());
  with_threads(options.threads, [&] {
    for (int round = 0; round < options.rounds; ++round)
      for (std::size_t c = 0; c < contenders.size(); ++c)
        run_round(contenders[c], subject, options, all[c]);
  });
  std::vector<ImageTime> times;
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const Rounds &rounds = all[c], &base = all[0];
    ImageTime time = rounds.last;
    time.contender = contenders[c].name;
    time.build_seconds = median(rounds.build);
    time.hierarchy_seconds = median(rounds.hierarchy);
    time.trace_seconds = median(rounds.trace);
    time.image_ratio = ratio_of(rounds.image, base.image);
    time.build_ratio = ratio_of(rounds.build, base.build);
    time.hierarchy_ratio = ratio_of(rounds.hierarchy, base.hierarchy);
    time.trace_ratio = ratio_of(rounds.trace, base.trace);
    time.picture_difference = difference(base.picture, rounds.picture);
    times.push_back(std::move(time));
  }
  return times;
}

}  // namespace minkray::bench
