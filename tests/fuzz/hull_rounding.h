// SPDX-License-Identifier: MIT
// Tolerance of a vertex outside of the hull that is made of it.
#pragma once

#include <limits>

namespace minkray::fuzz {

/// As in core/geometry/convex_hull.cpp: a set thinner than 16 epsilon of its coordinates is flat;
/// a facet's plane is rounded by as much again, in each of three dimensions.
constexpr double hull_rounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace minkray::fuzz
