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

/// Bounds the displacement of a point at this distance from the origin by rounding of a map's
/// entries. Scales and swaps of axes are exact; other maps may have been computed from a
/// quaternion.
double loss_of_turning(const Mat3<double>& linear, double distance);

/// Moves a shape if its support points are computed from coordinates much larger than the shape.
/// Returns nothing for other shapes.
std::optional<Recentred> recentred(const Shape& shape);

/// Upper bound of the lengths of all vectors that are summed in a support point. For custom shapes,
/// these are the support points.
double largest_coordinate(const Shape& shape);

}  // namespace minkray
