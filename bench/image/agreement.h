// SPDX-License-Identifier: MIT
// Checks that two tracers get the same hits: a speed without that is no result.
#pragma once

#include <span>

#include "bench/image/tracer.h"

namespace minkray::bench {

/// Compares the results for the same rays.
struct Agreement {
  std::size_t rays = 0, hits = 0;  ///< hits: of the reference
  std::size_t only_one = 0;        ///< rays that only one of the two saw meet something
  std::size_t other_instance = 0;  ///< both did, but not the same instance
  double typical = 0;              ///< the median of |t - t'| where both met the same instance
  double most_of_all = 0;          ///< the 99th percentile
};

Agreement compare(std::span<const FirstHit> reference, std::span<const FirstHit> other);

}  // namespace minkray::bench
