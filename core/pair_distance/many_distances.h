// SPDX-License-Identifier: MIT
// Many signed distances at once: one pair in many poses, or many pairs. Each answer has the bits
// of signed_distance() by itself, whatever the number of threads.
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

/// `answers` has as many places as there are pairs.
void signed_distances(std::span<const PosedPair> pairs, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options = {});

/// A is fixed, B is at one pose after the other.
void signed_distances(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                      std::span<const Affine<double>> poses_b, std::span<SignedDistance> answers,
                      const SignedDistanceOptions& options = {});

/// Keeps a memory for each pair: as many as pairs.
void signed_distances(std::span<const PosedPair> pairs, std::span<PairMemory> memories,
                      std::span<SignedDistance> answers, const SignedDistanceOptions& options = {});

}  // namespace minkray
