// SPDX-License-Identifier: MIT
// Signed distance of two cores that have no closed form: searches for the distance and, if the
// cores overlap or touch, for the depth.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

struct SignedDistanceOptions;

/// A query ends at this gap of the bounds, relative to the sizes. Queries with a larger gap go to
/// branch and bound.
inline constexpr double settled_core_gap = 1e-9;

/// A's kind must not be after B's. `memory` may be null.
CoreDistance core_signed_distance(const CorePair& pair, const SignedDistanceOptions& options,
                                  PairMemory* memory);

}  // namespace minkray
