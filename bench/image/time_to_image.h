// SPDX-License-Identifier: MIT
// From a scene that has been read to its picture: what building and tracing take, and what memory.
#pragma once

#include "bench/image/contender.h"
#include "bench/image/frame.h"
#include "bench/image/subject.h"

namespace minkray::bench {

struct ImageOptions {
  Resolution resolution{960, 540};
  int samples = 1;
  int threads = 1;
  int rounds = 1;
};

/// Medians of the rounds; on one thread of its processor time, on several of the wall's clock.
struct ImageTime {
  std::string contender, entry;
  double build_seconds = 0, hierarchy_seconds = 0, trace_seconds = 0;
  double image_ratio = 0;  ///< build and trace, by ours
  double build_ratio = 0, hierarchy_ratio = 0, trace_ratio = 0;
  std::size_t rays = 0;
  std::size_t bytes = 0;          ///< by itself
  std::size_t heap_bytes = 0;     ///< by what the process had allocated before and after
  double picture_difference = 0;  ///< the mean of |pixel - our pixel|
};

/// Each contender is made, traces the picture, and goes, round after round.
std::vector<ImageTime> measure_images(const Subject& subject,
                                      const std::vector<Contender>& contenders,
                                      const ImageOptions& options);

}  // namespace minkray::bench
