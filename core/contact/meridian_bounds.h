// SPDX-License-Identifier: MIT
// The signed distance of two cores of revolution about parallel axes: a peg in its hole, a wheel on
// its axle, concentric shells. Where the two axes are one, every direction around it is as good as
// the next: what looks for one direction among all (a polytope, cells of the sphere) ends with a
// ring of them, of which it needs a hundred thousand for ten digits.
//
// g(n) = min n.c over c of C is n.x less what depends on the angle of n and the axes only. Of all n
// at one angle that with the largest n.x is in the half plane from the axis to where x points, so
// no other is looked at: by branch and bound as in direction_bounds.h, over arcs instead of
// triangles. Between two directions g is no larger than n.c of either one's support point: two
// sinusoids, of which each is the lower one on its own side of where they are equal.
#pragma once

#include <optional>

#include "core/contact/core_pair.h"

namespace minkray {

/// Nothing if the cores are not of revolution about axes that are parallel but for a millionth, or
/// if it did not close. What they are not is allowed for; if that is more than the gap is, the
/// bounds hold and `is_exhausted`. `gap` is upper - lower, relative to the size and the distance of
/// the middles. `known` is where it starts; a and c are not found.
std::optional<CoreDistance> bound_along_meridian(const CorePair& pair, const CoreDistance& known,
                                                 double gap);

}  // namespace minkray
