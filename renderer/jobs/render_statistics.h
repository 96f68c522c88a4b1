// SPDX-License-Identifier: MIT
// Cost of a rendering, for `minkray render --stats`.
#pragma once

#include <string>

#include "renderer/film/render.h"

namespace minkray {

struct RenderStatistics {
  std::size_t objects = 0;
  int threads = 0;
  double load_seconds = 0, build_seconds = 0, trace_seconds = 0, write_seconds = 0;
  std::size_t world_bytes = 0, bvh_bytes = 0;
  RayCounts counts;
  double noise = -1;  ///< Rendering::noise

  /// Sets the values that are known before the first ray.
  void describe(const Scene& scene, const World& world);

  double per_object(std::size_t bytes) const {
    return static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(objects, 1));
  }
  double per_ray(std::uint64_t count) const {
    const auto rays = static_cast<double>(std::max<std::uint64_t>(counts.total(), 1));
    return static_cast<double>(count) / rays;
  }
};

/// Warns on stderr about the counts, and prints statistics on stdout as `stats` requests: nothing
/// (empty), text ("true") or JSON ("json").
void report(const RenderStatistics& statistics, const std::string& stats);

}  // namespace minkray
