// SPDX-License-Identifier: MIT
// Shapes far from their own origin, moved to it without rounding: what solvers work out of them is
// rounded to the shape's size then, not to how far away it stands.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace minkray {

/// The given shape is this one, moved by `moved`.
template <class T>
struct Recentred {
  Shape<T> shape;
  Vec3<T> moved;  ///< zero along axes on which the shape is about as large as it is far away
};

/// Moves what lies further away than it is large and can be moved without rounding: hulls,
/// triangles, segments and cut cylinders, what a map moves away, and what is rounded, summed or the
/// hull of such. It returns nothing for others.
template <class T>
std::optional<Recentred<T>> recentred(const Shape<T>& shape);

extern template std::optional<Recentred<float>> recentred(const Shape<float>&);
extern template std::optional<Recentred<double>> recentred(const Shape<double>&);

}  // namespace minkray
