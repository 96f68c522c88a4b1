// SPDX-License-Identifier: MIT
// Shapes whose proportions exceed the design of the solvers' rounding: needles, plates and slivers
// of more than 1 : 10^4 to 10^6, and edges as sharp next to faces.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// True if any of its component shapes is so much longer than it is thick, the maps around it
/// included, or so much larger than another of them. Operands without any thickness (disks,
/// segments, flat hulls) are not thin; points in double that lie on a line but for rounding are.
/// Superellipsoids whose edges are nearly, but not quite, sharp count as well.
bool has_extreme_proportions(const Shape& shape);

}  // namespace minkray
