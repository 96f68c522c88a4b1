// SPDX-License-Identifier: MIT
// Many signed distances at once: one pair in many poses, or many pairs. Results are bit-identical
// to those of signed_distance() for any number of threads.
#pragma once

#include <span>

#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// Two bodies and their poses. Their shapes must outlive the query.
struct PosedPair {
  const ContactShape* a = nullptr;
  const ContactShape* b = nullptr;
  Affine<double> pose_a;
  Affine<double> pose_b;
};

/// Writes one result per pair.
void signed_distances(std::span<const PosedPair> pairs, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options = {});

/// Returns the distances of A at one pose from B at each of `poses_b`.
void signed_distances(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                      std::span<const Affine<double>> poses_b, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options = {});

/// Warm start: `memories` has one item per pair.
void signed_distances(std::span<const PosedPair> pairs, std::span<PairMemory> memories,
                      std::span<SignedDistance> answers, const SignedDistanceOptions& options = {});

}  // namespace minkray
