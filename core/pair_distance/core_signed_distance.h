// SPDX-License-Identifier: MIT
// Signed distance of two cores that have no closed form: searches for the distance and, if the
// cores overlap or touch, for the depth.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

struct SignedDistanceOptions;

/// Gap of the bounds, relative to the sizes, at which a query ends. Queries with a larger gap
/// continue with branch and bound (direction_bounds.h).
inline constexpr double settled_core_gap = 1e-9;

/// Returns the signed distance. A's kind must not be after B's in CoreKind. `memory` may be null.
CoreDistance core_signed_distance(const CorePair& pair, const SignedDistanceOptions& options,
                                  PairMemory* memory);

}  // namespace minkray
