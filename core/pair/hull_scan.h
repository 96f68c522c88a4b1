// SPDX-License-Identifier: MIT
// Finds which of a hull's points lies furthest along a direction: a scan of all of them, eight at
// a time.
#pragma once

#include "core/derived/core_and_radius.h"

namespace minkray {

/// An index below hull.count. The same on every machine: with and without AVX2 the same numbers are
/// compared in the same order.
int furthest_of_hull(const ShapeCore& hull, double x, double y, double z);

}  // namespace minkray
