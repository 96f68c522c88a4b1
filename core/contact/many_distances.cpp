// SPDX-License-Identifier: MIT
#include "core/contact/many_distances.h"

#include <cassert>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// A thread takes so many at a time.
constexpr std::size_t grain = 256;

}  // namespace

void signed_distances(std::span<const PosedPair> pairs, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options) {
  assert(answers.size() == pairs.size());
  parallel_for(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PosedPair& pair = pairs[i];
      answers[i] = signed_distance(*pair.a, pair.pose_a, *pair.b, pair.pose_b, options);
    }
  });
}

void signed_distances(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                      std::span<const Affine<double>> poses_b, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options) {
  assert(answers.size() == poses_b.size());
  parallel_for(poses_b.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      answers[i] = signed_distance(a, pose_a, b, poses_b[i], options);
  });
}

void signed_distances(std::span<const PosedPair> pairs, std::span<PairMemory> memories,
                      std::span<SignedDistance> answers, const SignedDistanceOptions& options) {
  assert(answers.size() == pairs.size() && memories.size() == pairs.size());
  parallel_for(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PosedPair& pair = pairs[i];
      answers[i] =
          signed_distance(*pair.a, pair.pose_a, *pair.b, pair.pose_b, memories[i], options);
    }
  });
}

}  // namespace minkray
