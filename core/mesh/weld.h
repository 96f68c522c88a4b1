// SPDX-License-Identifier: MIT
// Merges vertices at the same position, since an STL file has three vertices for each triangle.
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// For each vertex, the number of the first vertex with the same coordinates (0 equals -0).
std::vector<std::uint32_t> first_at_place(std::span<const Vec3<double>> vertices);

/// Keeps the first vertex at each position, in order, and renumbers the triangles' corners.
void weld(std::vector<Vec3<double>>& vertices, std::vector<Corners>& triangles);

}  // namespace minkray
