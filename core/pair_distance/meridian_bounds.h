// SPDX-License-Identifier: MIT
// Signed distance of two cores of revolution about parallel axes: a peg in its hole, a wheel on its
// axle, concentric shells. If the axes coincide, all directions around them are equally good, and a
// search of all directions (a polytope, cells of the sphere) would test a hundred thousand
// directions.
#pragma once

#include <optional>

#include "core/pair/core_pair.h"

namespace minkray {

/// Returns nullopt unless both cores are of revolution, about axes that are parallel to 1e-6, and
/// the bounds meet. The bounds include the deviation from parallel axes; if this exceeds the gap,
/// the bounds hold and `is_exhausted` is set. `gap` is upper - lower, relative to the size and the
/// distance of the middles. Starts from `known`; a and c are not set.
///
/// g(n) = min n.c over c of C is n.x minus a function of the angle between n and the axes. At each
/// angle the n with the largest n.x is in the half plane from the axis towards x. So only this half
/// plane is searched, by branch and bound as in direction_bounds.h, over arcs instead of triangles.
/// Between two directions, g is at most n.c for the support point c of either direction. These two
/// bounds are sinusoids that cross once.
std::optional<CoreDistance> bound_along_meridian(const CorePair& pair, const CoreDistance& known,
                                                 double gap);

}  // namespace minkray
