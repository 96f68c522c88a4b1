// SPDX-License-Identifier: MIT
// Compares casters on the same rays: their times, relative to the baseline's, and their errors.
//
// All casters answer the same batch of rays in turn, round after round, so that a noisy moment hits
// all of them; a caster's speed is the median over the rounds of its time divided by that of the
// baseline in the same round.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/peers/peer.h"
#include "bench/truth.h"
#include "renderer/json/json.h"

namespace minkray::bench {

/// The one that all times are divided by.
inline constexpr std::string_view baseline = "minkray-auto";

struct Measured {
  std::string name;
  std::size_t triangles = 0;
  double nanoseconds = 0;  ///< a ray
  double ratio = 0;        ///< to the baseline
  Judgement judgement;
};

std::vector<Measured> measure(const Peers& peers, const Shape& shape, const RaysWithTruth& rays,
                              int rounds);

Json as_json(const Measured& measured);

/// Prints one line a caster.
void print(const std::string& subject, const std::string& family,
           const std::vector<Measured>& measured);

}  // namespace minkray::bench
