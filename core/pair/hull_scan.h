// SPDX-License-Identifier: MIT
// Finds which of a hull's points is furthest along a direction, by scanning all points, eight at a
// time.
#pragma once

#include "core/derived/core_and_radius.h"

namespace minkray {

/// Returns an index below hull.count; the same on every machine, as the same numbers are compared
/// in the same order with and without AVX2.
int furthest_of_hull(const ShapeCore& hull, double x, double y, double z);

}  // namespace minkray
