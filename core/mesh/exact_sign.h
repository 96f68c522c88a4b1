// SPDX-License-Identifier: MIT
// Exact side of an edge on which a ray passes. Two triangles that share the edge get the same side,
// so no ray passes between them.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// The sign of d . ((a - o) x (b - a)): -1, 0 or 1. Uses sums without rounding (Shewchuk, "Adaptive
/// Precision Floating-Point Arithmetic", 1997), so the sign is exact unless a product leaves the
/// range of double: then, and for numbers that are not finite, 0.
int exact_side_of_edge(const Vec3<double>& o, const Vec3<double>& d, const Vec3<double>& a,
                       const Vec3<double>& b);

/// The sign of (b - a) x (c - a) . (d - a): positive if d is on the side from which the triangle
/// abc is counter-clockwise. Exact under the same condition.
int exact_side_of_plane(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
                        const Vec3<double>& d);

}  // namespace minkray
