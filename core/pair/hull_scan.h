// SPDX-License-Identifier: MIT
// Finds the point of a hull that is furthest along a direction by scanning all points, eight at a
// time.
#pragma once

#include "core/derived/core_and_radius.h"

namespace minkray {

/// Returns an index below hull.count. The result is the same on every machine: with and without
/// AVX2, the same numbers are compared in the same order.
int furthest_of_hull(const ShapeCore& hull, double x, double y, double z);

}  // namespace minkray
