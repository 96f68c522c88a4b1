// SPDX-License-Identifier: MIT
// Finds the points of a hull that are furthest along a direction by scanning all points, several at
// a time.
#pragma once

#include <cstdint>

#include "core/derived/core_and_radius.h"

namespace minkray {

/// Returns an index below hull.count. The result is the same on every machine: with and without
/// AVX2, the same numbers are compared in the same order.
int furthest_of_hull(const ShapeCore& hull, double x, double y, double z);

/// Returns a bit for each of the 64 points from `begin` on: 1 if the point is at least `least` far
/// along the direction. The same on every machine, too.
std::uint64_t far_of_hull(const ShapeCore& hull, double x, double y, double z, double least,
                          int begin);

}  // namespace minkray
