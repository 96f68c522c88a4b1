// SPDX-License-Identifier: MIT
// The signed distance of two cores that have no closed form: by a search for the distance, and
// where they overlap, or touch, for the depth.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

struct SignedDistanceOptions;

/// Gap of the bounds, relative to the sizes, at which a query is settled. Others go to branch and
/// bound.
inline constexpr double settled_core_gap = 1e-9;

/// A's kind is not after B's. There may be a memory.
CoreDistance core_signed_distance(const CorePair& pair, const SignedDistanceOptions& options,
                                  PairMemory* memory);

}  // namespace minkray
