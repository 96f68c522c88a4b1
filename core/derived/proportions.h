// SPDX-License-Identifier: MIT
// Detects proportions for which the solvers' tolerances for rounding are not designed: needles,
// plates and slivers of more than 1 : 10^4 to 10^6, and edges rounded by similarly small radii.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// True if a component shape, with the maps around it, is much longer than it is thick, or much
/// larger than another component. Components without any thickness (disks, segments, flat hulls) do
/// not count as thin, but hulls of points that are collinear only up to rounding do. True also for
/// components whose edges are nearly, but not quite, sharp.
bool has_extreme_proportions(const Shape& shape);

}  // namespace minkray
