// SPDX-License-Identifier: MIT
#include "core/pair_distance/many_distances.h"

#include <cassert>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Computes each result separately, on all cores.
template <class Ask>
void answer_all(std::span<SignedDistance> answers, const Ask& ask) {
  constexpr std::size_t grain = 256;  // number of pairs that a thread takes at a time
  parallel_for(answers.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) answers[i] = ask(i);
  });
}

}  // namespace

void signed_distances(std::span<const PosedPair> pairs, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options) {
  assert(answers.size() == pairs.size());
  answer_all(answers, [&](std::size_t i) {
    return signed_distance(*pairs[i].a, pairs[i].pose_a, *pairs[i].b, pairs[i].pose_b, options);
  });
}

void signed_distances(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                      std::span<const Affine<double>> poses_b, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options) {
  assert(answers.size() == poses_b.size());
  answer_all(answers,
             [&](std::size_t i) { return signed_distance(a, pose_a, b, poses_b[i], options); });
}

void signed_distances(std::span<const PosedPair> pairs, std::span<PairMemory> memories,
                      std::span<SignedDistance> answers, const SignedDistanceOptions& options) {
  assert(answers.size() == pairs.size() && memories.size() == pairs.size());
  answer_all(answers, [&](std::size_t i) {
    return signed_distance(*pairs[i].a, pairs[i].pose_a, *pairs[i].b, pairs[i].pose_b, memories[i],
                           options);
  });
}

}  // namespace minkray
