// SPDX-License-Identifier: MIT
// Shapes whose support points would be rounded to how far away they are, brought to where they are
// rounded to the shape's own size. Translations inside of sums, differences, hulls and nests of
// maps are taken out and added up in twice the digits.
#pragma once

#include <optional>

#include "core/math/two_fold.h"
#include "core/shape/shape.h"

namespace minkray {

/// The given shape is this one, moved by `moved`, but for roundings of this one's size.
struct Recentred {
  Shape shape;
  TwoFoldVec3<double> moved;
  double loss = 0.0;  ///< a bound of what rounding maps' entries may have moved it by
};

/// A bound of how much longer the map makes vectors; of a rotation, 1 but for rounding.
double stretch_of(const Mat3<double>& linear);

/// Bounds the displacement of a point at this distance by rounding of a map's entries. Scales and
/// swaps of axes are exact; other maps may have been made of a quaternion.
double loss_of_turning(const Mat3<double>& linear, double distance);

/// Moves a shape, if its support points are made of coordinates much larger than itself; it returns
/// nothing for others.
std::optional<Recentred> recentred(const Shape& shape);

/// A bound of all coordinates that a support point is made of, as a length. Custom shapes have
/// those of their support points.
double largest_coordinate(const Shape& shape);

}  // namespace minkray
