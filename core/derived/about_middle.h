// SPDX-License-Identifier: MIT
// A shape known by its support mapping, rebuilt about its own middle: its support points are
// numbers of its own size then, wherever it is and whatever maps it is under.
#pragma once

#include <vector>

#include "core/shape/shape.h"
#include "core/support/composed_map.h"

namespace minkray {

struct AboutMiddle {
  Shape shape;
  TwoFoldVec3<double> middle;  ///< in the frame that the map leads to
  double loss = 0;             ///< by how much the shape may be off, a length
};

/// Maps of operands become one map for each innermost shape, points are mapped one by one, and what
/// is far from the origin of its own frame is moved there; a program's support mapping cannot be,
/// which is a loss.
AboutMiddle about_middle(const Shape& shape, const ComposedMap& map);

/// Bounds the error of an image of a shape that is about its origin, caused by rounding of the
/// map's turns. A map that keeps angles may have one of those turns for free, since its effect on
/// a shape is an epsilon of the shape's size.
double loss_of_turns(const Shape& shape, const ComposedMap& map, double similarity);

/// The shape, moved by a vector that is not long compared with its size.
Shape moved_by(const Shape& shape, const Vec3<double>& way);

/// Points under a map, about the middle of their box, which is at `middle` + `points[i]`.
struct PointsAboutMiddle {
  std::vector<Vec3<double>> points;
  Vec3<double> middle;
  double loss = 0;
};
PointsAboutMiddle points_about_middle(const std::vector<Vec3<double>>& points,
                                      const ComposedMap& map);

}  // namespace minkray
