// SPDX-License-Identifier: MIT
// Moves a shape to the origin if its support points are so far away that their rounding is large
// compared with the shape. Translations within sums, differences, hulls and nested maps are removed
// from the shape and added up with twice the digits.
#pragma once

#include <optional>

#include "core/math/two_fold.h"
#include "core/shape/shape.h"

namespace minkray {

/// The given shape equals `shape` moved by `moved`, up to rounding relative to the size of `shape`.
struct Recentred {
  Shape shape;
  TwoFoldVec3<double> moved;
  double loss = 0.0;  ///< error bound of `moved`, due to rounded entries of maps
};

/// Upper bound of the factor by which the map lengthens vectors; for a rotation, 1 up to rounding.
double stretch_of(const Mat3<double>& linear);

/// Bounds how far rounding of the map's entries displaces a point at this distance from the origin.
/// Scales and swaps of axes are taken as exact; the entries of other maps may have been computed
/// from a quaternion.
double loss_of_turning(const Mat3<double>& linear, double distance);

/// Moves a shape if its support points are computed from coordinates much larger than the shape.
/// Returns nothing for other shapes.
std::optional<Recentred> recentred(const Shape& shape);

/// Upper bound of the lengths of all vectors that are added up to compute a support point. A custom
/// shape's support point counts as one vector.
double largest_coordinate(const Shape& shape);

}  // namespace minkray
