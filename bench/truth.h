// SPDX-License-Identifier: MIT
// Rays with their exact answers, and how far an answer is from that.
#pragma once

#include <string>
#include <string_view>

#include "bench/peers/peer.h"

namespace minkray::bench {

/// The kinds of tests/support/ray_families.h, and "coherent": a camera's, in blocks of 4 x 2
/// pixels.
std::vector<std::string> family_names();

/// Result of closed forms in long double where there is one, else of a slow portal refinement in
/// long double (tests/oracle).
struct Truth {
  enum class Answer : unsigned char { hit, miss, unknown } answer = Answer::unknown;
  long double t_base = 0, t_offset = 0;  ///< t is their sum
  Vec3<double> normal = Vec3<double>::Zero();
  bool is_smooth =
      false;  ///< the surface is curved no more than at a tenth of R: the normal counts
};

struct RaysWithTruth {
  RayBatch batch;
  std::vector<Truth> truths;
  double radius = 0;
};

/// Rays at the shape as rounded to float, so that all precisions mean the same one.
RaysWithTruth make_rays(const Shape& shape, std::string_view family, std::size_t count);

struct Spread {
  double mean = 0, most_of_all = 0, max = 0;  ///< most_of_all: 99.9 % are no more

  static Spread of(std::vector<double>& values);
};

/// Lengths in units of the bounding radius R; angles in radians.
struct Judgement {
  std::size_t rays = 0, hits = 0, unknown = 0, exhausted = 0;
  /// Hit and miss mistaken, in all and further than `band` from the silhouette.
  std::size_t wrong = 0, false_hits = 0, false_misses = 0;
  double band = 0;
  Spread supports_of_hits, supports_of_misses;
  Spread along_normal;     ///< |t - exact| * cosine
  Spread along_ray;        ///< |t - exact|
  Spread normal_angle;     ///< of smooth places, from peers that return normals
  std::uint64_t hash = 0;  ///< of all answers, bit by bit
};

/// `band` is 1e-6 for answers in float and 1e-12 in double.
Judgement judge(const Shape& shape, const RaysWithTruth& rays, std::span<const Hit> hits,
                double band);

}  // namespace minkray::bench
