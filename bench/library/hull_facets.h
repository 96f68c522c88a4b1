// SPDX-License-Identifier: MIT
// The triangles of a convex hull, point by point (Preparata and Hong, 1977), for some hundred
// points in general position: none is within rounding of a plane of others.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vec.h"

namespace bench {

/// Indices, counter-clockwise from outside. Throws std::runtime_error if all points are in a plane.
std::vector<std::array<std::uint32_t, 3>> hull_facets(const std::vector<Vec>& points);

}  // namespace bench
