// SPDX-License-Identifier: MIT
// Signed distance of two cores by branch and bound over directions: the slowest method, but it
// needs only support points, handles every degeneracy, and proves its result.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

struct DirectionSearch {
  double gap = 1e-10;        ///< the search ends at this upper - lower, relative to the size
  int max_supports = 50000;  ///< at this limit the search ends with the bounds reached so far
  /// If true, the search ends as soon as the sign of the distance is proven.
  bool only_sign = false;
};

/// Starts from `known.lower` and `known.axis`. For an overlap, `upper` is negative: minus the
/// penetration depth. Sets `is_exhausted` if the bounds are further apart than requested; does not
/// set a and c.
///
/// The signed distance is the maximum over all unit vectors n of g(n) = min n.c over c of C. Any n
/// gives a lower bound. For an upper bound the sphere of directions is cut into triangles. With the
/// support points c_j of a triangle's corners, g(n) <= u(n) = min_j n.c_j. If u is negative, each
/// n.c_j is a convex function along great circles. The maximum of u is then at one of a few
/// candidates: at a corner, on a side where two n.c_j are equal, or inside where all three are
/// equal. If u is positive, the same holds on the flat triangle; on the sphere, u is larger by at
/// most the triangle's sagitta. The triangle with the largest bound is halved until the bounds
/// meet.
CoreDistance bound_by_directions(const CorePair& pair, const CoreDistance& known,
                                 const DirectionSearch& search = {});

}  // namespace minkray
