// SPDX-License-Identifier: MIT
// Order of the surfaces along a line that passes exactly through edges or vertices: computed for a
// line nearby that meets none (Edelsbrunner and Muecke, "Simulation of Simplicity", 1990). The
// line is moved by amounts smaller than any number, so results are those of a true line: it passes
// a closed surface equally often in and out.
#pragma once

#include <array>

#include "core/math/ray.h"

namespace minkray {

/// Same as exact_side_of_edge for a ray moved as described: never 0 unless a and b are equal.
int moved_side_of_edge(const Vec3<double>& o, const Vec3<double>& d, const Vec3<double>& a,
                       const Vec3<double>& b);

using TriangleCorners = std::array<Vec3<double>, 3>;

/// Order in which a ray meets the planes of two triangles, neither of them parallel to it: -1 if
/// the first plane comes first, 1 if the second does. Where the ray meets both at one point, the
/// order is that of the moved ray; 0 if the planes are the same. Exact unless products of six
/// coordinates, relative to the largest, leave the range of double.
int order_along(const Ray<double>& ray, const TriangleCorners& first,
                const TriangleCorners& second);

}  // namespace minkray
