// SPDX-License-Identifier: MIT
// Vertices at one place become one: an STL file has three for each triangle.
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// For each vertex the first one that has just its coordinates (0 and -0 are the same).
std::vector<std::uint32_t> first_at_place(std::span<const Vec3<double>> vertices);

/// Keeps the first vertex at each place, in their order, and renumbers triangles' corners.
void weld(std::vector<Vec3<double>>& vertices, std::vector<Corners>& triangles);

}  // namespace minkray
