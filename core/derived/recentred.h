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
template <class T>
struct Recentred {
  Shape<T> shape;
  TwoFoldVec3<T> moved;
  T loss = T(0);  ///< a bound of what rounding maps' entries may have moved it by
};

/// A bound of how much longer the map makes vectors; of a rotation, 1 but for rounding.
template <class T>
T stretch_of(const Mat3<T>& linear);

/// Bounds the displacement of a point at this distance by rounding of a map's entries. Scales and
/// swaps of axes are exact; other maps may have been made of a quaternion.
template <class T>
T loss_of_turning(const Mat3<T>& linear, T distance);

/// Moves a shape, if its support points are made of coordinates much larger than itself; it returns
/// nothing for others.
template <class T>
std::optional<Recentred<T>> recentred(const Shape<T>& shape);

/// A bound of all coordinates that a support point is made of, as a length. Custom shapes have
/// those of their support points.
template <class T>
T largest_coordinate(const Shape<T>& shape);

extern template std::optional<Recentred<float>> recentred(const Shape<float>&);
extern template std::optional<Recentred<double>> recentred(const Shape<double>&);
extern template double stretch_of(const Mat3<double>&);
extern template float stretch_of(const Mat3<float>&);
extern template double loss_of_turning(const Mat3<double>&, double);
extern template float loss_of_turning(const Mat3<float>&, float);
extern template float largest_coordinate(const Shape<float>&);
extern template double largest_coordinate(const Shape<double>&);

}  // namespace minkray
