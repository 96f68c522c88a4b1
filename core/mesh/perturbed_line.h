// SPDX-License-Identifier: MIT
// Order of the surfaces along a line that passes exactly through edges or vertices: computed for a
// line nearby that meets no edge or vertex (Edelsbrunner and Muecke, "Simulation of Simplicity",
// 1990). The line is moved by less than any positive number, and results are those of the moved
// line, which enters a closed surface as often as it leaves.
#pragma once

#include <array>

#include "core/math/ray.h"

namespace minkray {

/// Same as exact_side_of_edge, for the moved line: never 0 unless a and b are equal.
int moved_side_of_edge(const Vec3<double>& o, const Vec3<double>& d, const Vec3<double>& a,
                       const Vec3<double>& b);

using TriangleCorners = std::array<Vec3<double>, 3>;

/// Order in which a ray meets the planes of two triangles, neither plane parallel to the ray: -1 if
/// the ray meets the first plane first, 1 if the second. If the ray meets both planes at one point,
/// the order is that of the moved ray; 0 if the planes are the same. Exact unless, after division
/// of the coordinates by the largest one, a product of six of them leaves the range of double.
int order_along(const Ray<double>& ray, const TriangleCorners& first,
                const TriangleCorners& second);

}  // namespace minkray
