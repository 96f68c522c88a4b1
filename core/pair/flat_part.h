// SPDX-License-Identifier: MIT
// The part of a core that lies as far along a direction as its support point does: a vertex, an
// edge or a face. If this is more than a vertex for both bodies of a pair, there may be many pairs
// of nearest points.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

struct FlatPart {
  int dimension = 0;                           ///< 0: a vertex, or curved; 1: an edge; 2: a face
  Vec3<double> along = Vec3<double>::UnitZ();  ///< an edge's direction, of unit length
  double length = 0;                           ///< of the edge
};

/// Uses the direction with the largest part among those within `tilt` radians of the unit vector d.
/// For a core known only by its support mapping, the part is spanned by support points in
/// directions tilted slightly from d.
FlatPart flat_part(const ShapeCore& core, const Vec3<double>& d, double tilt);

}  // namespace minkray
