// SPDX-License-Identifier: MIT
// All points of a core that are furthest along a direction: a vertex, an edge or a face. If both
// bodies of a pair have an edge or a face there, there may be many pairs of nearest points.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

struct FlatPart {
  int dimension = 0;                           ///< 0: a vertex, or curved; 1: an edge; 2: a face
  Vec3<double> along = Vec3<double>::UnitZ();  ///< an edge's direction, of unit length
  double length = 0;                           ///< of the edge
};

/// Returns the largest part for any direction within `tilt` radians of the unit vector d. For a
/// core known only by its support mapping, support points in slightly tilted directions span the
/// part.
FlatPart flat_part(const ShapeCore& core, const Vec3<double>& d, double tilt);

}  // namespace minkray
