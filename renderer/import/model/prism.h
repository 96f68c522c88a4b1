// SPDX-License-Identifier: MIT
// Splits extruded outlines (SDF's <polyline>) into convex prisms. Outlines may be of any shape, and
// nested as holes (even-odd rule). A convex outline is one prism; others are cut at their corners
// into trapezoids (trapezoidal decomposition by a sweep; de Berg et al., Computational Geometry,
// 2008, chapter 6).
#pragma once

#include <array>
#include <vector>

#include "core/shape/shape.h"

namespace minkray {

using Outline = std::vector<std::array<double, 2>>;

/// The prisms between z = 0 and z = height, which must be > 0. Throws std::runtime_error if the
/// outlines enclose nothing, or need more than 100,000 prisms.
std::vector<Shape> prisms_of(const std::vector<Outline>& outlines, double height);

}  // namespace minkray
