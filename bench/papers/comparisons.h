// SPDX-License-Identifier: MIT
// What is compared with other libraries, for one pair of shapes each.
#pragma once

#include "bench/papers/contest.h"
#include "bench/papers/everywhere.h"

namespace minkray::bench {

/// Distances, beside Bullet and FCL.
void compare_distances(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

/// Whether two shapes overlap, beside libccd.
void compare_overlaps(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

/// Shape casts, beside Bullet and FCL. Peers differ in what an overlap at the start is: queries
/// that begin so are left out.
void compare_casts(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list);

}  // namespace minkray::bench
