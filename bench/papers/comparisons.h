// SPDX-License-Identifier: MIT
// Comparisons with other libraries, for one pair of shapes each.
#pragma once

#include "bench/papers/contest.h"
#include "bench/papers/everywhere.h"

namespace minkray::bench {

/// Distances, compared with Bullet and FCL.
void compare_distances(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

/// Overlap tests, compared with libccd.
void compare_overlaps(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

/// Shape casts, compared with Bullet and FCL. Peers differ on an overlap at the start: queries
/// that begin so are left out.
void compare_casts(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

}  // namespace minkray::bench
