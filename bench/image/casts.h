// SPDX-License-Identifier: MIT
// Nothing but casts: all tracers answer the same rays in turn, round after round, so that a noisy
// moment hits all of them.
#pragma once

#include "bench/image/agreement.h"
#include "bench/image/contender.h"
#include "bench/image/subject.h"

namespace minkray::bench {

struct CastSpeed {
  std::string contender, entry;
  double nanoseconds = 0;  ///< a ray, on one thread: the median of the rounds
  double ratio = 0;        ///< to ours, entry by best entry: the median of the rounds' ratios
  Agreement agreement;     ///< with our answers
};

/// Kind of rays, and their query: the first hit or, for shadows, if there is any.
enum class RayKindAsked : unsigned char { camera, scattered, scattered_shadows, light_shadows };

struct CastResults {
  RayKindAsked kind = RayKindAsked::camera;
  std::string rays;  ///< the same in words
  std::size_t count = 0;
  double hit_rate = 0;
  std::vector<CastSpeed> speeds;

  /// The least ratio of the entries of contenders whose names begin so: their best case.
  double best_ratio(std::string_view contender) const;
};

/// Coherent rays of the camera, and incoherent ones: from where those arrive to all sides, in
/// random order. About `rays` of each. `with_shadows`: these are also tested for any hit, and so
/// are rays to the light.
std::vector<CastResults> measure_casts(const Subject& subject,
                                       const std::vector<Contender>& contenders, std::size_t rays,
                                       int rounds, bool with_shadows = false);

}  // namespace minkray::bench
