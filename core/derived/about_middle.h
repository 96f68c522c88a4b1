// SPDX-License-Identifier: MIT
// Moves a shape under a map so that its centre is at the origin, and rebuilds it there. Coordinates
// of its support points are then no larger than the shape, wherever the map puts the shape.
#pragma once

#include <vector>

#include "core/shape/shape.h"
#include "core/support/composed_map.h"

namespace minkray {

struct AboutMiddle {
  Shape shape;
  TwoFoldVec3<double> middle;  ///< position of the shape's origin in the mapped frame
  double loss = 0;             ///< error bound of the shape's position, a length
};

/// Rebuilds the image of `shape` under `map`, around the origin. Nested maps become one map per
/// innermost shape, and points are mapped one by one. A shape far from the origin of its own frame
/// is moved to that origin. Only for custom shapes does this move lose digits and increase `loss`.
AboutMiddle about_middle(const Shape& shape, const ComposedMap& map);

/// Error bound of the image, under `map`, of a shape around the origin. The errors stem from
/// rounding of the rotations in `map`. If the map scales all lengths equally, by `similarity` > 0,
/// one rotation is not counted, since its error is only an epsilon of the shape's size.
double loss_of_turns(const Shape& shape, const ComposedMap& map, double similarity);

/// Returns the shape moved by `way`, which must not be long compared with the shape's size.
Shape moved_by(const Shape& shape, const Vec3<double>& way);

/// Points under a map, relative to the middle of their box: point i is `middle` + `points[i]`.
struct PointsAboutMiddle {
  std::vector<Vec3<double>> points;
  Vec3<double> middle;
  double loss = 0;  ///< error bound of the points' positions
};
PointsAboutMiddle points_about_middle(const std::vector<Vec3<double>>& points,
                                      const ComposedMap& map);

}  // namespace minkray
