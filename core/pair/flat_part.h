// SPDX-License-Identifier: MIT
// Finds the part of a core that is furthest along a direction: a vertex, an edge or a face. If two
// bodies touch with edges or faces, there may be many pairs of nearest points.
#pragma once

#include <limits>

#include "core/pair/core_support.h"

namespace minkray {

struct FlatPart {
  int dimension = 0;  ///< 0: a vertex or a point of a curved surface; 1: an edge; 2: a face
  Vec3<double> along = Vec3<double>::UnitZ();  ///< direction of the edge, of unit length
  double length = 0;                           ///< length of the edge
};

inline constexpr double unknown_height = -std::numeric_limits<double>::infinity();

/// Returns the part of largest dimension over all directions within `tilt` radians of the unit
/// vector d. For a core known only by its support mapping, estimates the part from support points
/// in slightly tilted directions. `height`, if known, is that of the furthest point along d.
FlatPart flat_part(const ShapeCore& core, const Vec3<double>& d, double tilt,
                   double height = unknown_height);

}  // namespace minkray
