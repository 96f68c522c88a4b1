// SPDX-License-Identifier: MIT
// The part of a core that lies as far along a direction as its support point does: a vertex, an
// edge or a face. If both of two bodies have more than a vertex, there may be many pairs of
// nearest points.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

struct FlatPart {
  int dimension = 0;                           ///< 0: a vertex, or curved; 1: an edge; 2: a face
  Vec3<double> along = Vec3<double>::UnitZ();  ///< an edge's direction, of unit length
  double length = 0;                           ///< of the edge
};

/// Among the directions that lean by at most `tilt` radians from d (of unit length), uses the one
/// with the largest part. For a core known by its support mapping only, the part is the set of its
/// support points where d is tilted a little.
FlatPart flat_part(const ShapeCore& core, const Vec3<double>& d, double tilt);

}  // namespace minkray
