// SPDX-License-Identifier: MIT
#include "renderer/film/heatmap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/film/pixel_loop.h"
#include "renderer/rays/camera.h"

namespace minkray {
namespace {

float status_number(Status status) {
  const auto at = std::find(heat_statuses.begin(), heat_statuses.end(), status);
  return static_cast<float>(at - heat_statuses.begin());
}

float heat_of_ray(const World& world, const Ray<double>& ray, HeatChannel channel,
                  QueryCounts& counts) {
  QueryCounts work;
  const WorldHit hit = world.closest_hit({ray, no_instance, 0, camera_rays}, work);
  counts += work;
  switch (channel) {
    case HeatChannel::iterations:
      return static_cast<float>(work.iterations);
    case HeatChannel::supports:
      return static_cast<float>(work.supports);
    case HeatChannel::nodes:
      return static_cast<float>(work.nodes);
    case HeatChannel::casts:
      return static_cast<float>(work.casts);
    case HeatChannel::path:
      return static_cast<float>(work.furthest_path());
    case HeatChannel::status:
      break;
  }
  return status_number(work.exhausted > 0 ? Status::exhausted : hit.cast.status);
}

std::string formatted(const char* format, double a) {
  char text[64];
  std::snprintf(text, sizeof text, format, a);
  return text;
}

/// The least of 1, 2, 5, 10, 20, ... that is not less than x.
double round_step(double x) {
  double decade = 1;
  while (10 * decade < x) decade *= 10;
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= x) return step * decade;
  return 10 * decade;
}

std::string bar(double fraction, int width) {
  return std::string(static_cast<std::size_t>(std::lround(fraction * width)), '#');
}

}  // namespace

HeatChannel default_channel(const Scene& scene) {
  const bool has_shape = std::ranges::any_of(scene.objects, &Object::has_shape);
  return has_shape || !scene.particles.empty() ? HeatChannel::iterations : HeatChannel::nodes;
}

HeatField measure_heat(const Scene& scene, const World& world, HeatChannel channel,
                       const RenderOptions& options, const RenderWatch& watch) {
  const Camera camera(scene.camera, options.resolution);
  const PixelRect region = options.region();
  HeatField field{region.width(), region.height(), {}, {}, false};
  field.values.resize(pixel_count(region));

  const bool keeps_gravest = channel == HeatChannel::status || channel == HeatChannel::path;
  RayCounts counts;
  field.complete = for_pixels(region, counts, watch, [&](const Pixel& pixel, RayCounts& of_tile) {
    double sum = 0;
    float gravest = 0;
    for (int sample = 0; sample < options.samples && !watch.stopped(); ++sample) {
      Sampler sampler(options.seed, pixel.x, pixel.y, static_cast<std::uint32_t>(sample));
      const std::array<double, 2> at =
          options.samples == 1 ? std::array<double, 2>{0.5, 0.5} : sampler.next();
      const Ray<double> ray = camera.ray(pixel.x + at[0], pixel.y + at[1]);
      const float heat = heat_of_ray(world, ray, channel, of_tile.work);
      ++of_tile.camera;
      sum += static_cast<double>(heat);
      gravest = std::max(gravest, heat);
    }
    field.values[pixel.index] = keeps_gravest ? gravest : static_cast<float>(sum / options.samples);
  });
  field.work = counts.work;
  return field;
}

HeatSummary summary_of(const HeatField& field) {
  if (field.values.empty()) return {};
  const auto [least, most] = std::minmax_element(field.values.begin(), field.values.end());
  double sum = 0;
  for (const float value : field.values) sum += static_cast<double>(value);
  return {static_cast<double>(*least), sum / static_cast<double>(field.values.size()),
          static_cast<double>(*most)};
}

std::string heat_report(const HeatField& field, HeatChannel channel) {
  constexpr int bar_width = 50;
  const auto total = static_cast<double>(field.values.size());
  const auto line = [&](const std::string& label, std::size_t count, std::size_t largest) {
    char text[128];
    std::snprintf(text, sizeof text, "%14s %10zu  %6.2f %%  ", label.c_str(), count,
                  100 * static_cast<double>(count) / total);
    const double fraction =
        largest == 0 ? 0 : static_cast<double>(count) / static_cast<double>(largest);
    return text + bar(fraction, bar_width) + "\n";
  };

  if (channel == HeatChannel::status) {
    std::array<std::size_t, heat_statuses.size()> counts = {};
    for (const float value : field.values) ++counts[static_cast<std::size_t>(value)];
    std::string report;
    const std::size_t largest = *std::max_element(counts.begin(), counts.end());
    for (std::size_t i = 0; i < counts.size(); ++i)
      report += line(std::string(name_of(heat_statuses[i])), counts[i], largest);
    return report;
  }

  const HeatSummary summary = summary_of(field);
  std::string report = formatted("min %.6g", summary.least) +
                       formatted("  mean %.6g", summary.mean) +
                       formatted("  max %.6g", summary.most) + "\n";
  const double step = round_step((summary.most + 1) / 20);
  std::vector<std::size_t> counts(static_cast<std::size_t>(summary.most / step) + 1);
  for (const float value : field.values)
    ++counts[static_cast<std::size_t>(static_cast<double>(value) / step)];
  const std::size_t largest = *std::max_element(counts.begin(), counts.end());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = static_cast<double>(i) * step;
    const std::string label =
        step == 1 ? formatted("%.0f", from)
                  : formatted("%.0f", from) + formatted(" .. %.0f", from + step - 1);
    report += line(label, counts[i], largest);
  }
  return report;
}

}  // namespace minkray
