// SPDX-License-Identifier: MIT
// Minkowski sums that are rounded boxes in other words. The sum of a box and an ellipsoid along the
// same axes is, measured in the ellipsoid's radii, the sum of a box and the unit ball.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace minkray {

namespace detail {

/// The radii are those of ellipsoids along the axes; they are zero of other shapes.
template <class T>
Vec3<T> radii_of(const Shape<T>& shape) {
  if (const auto* ball = std::get_if<Sphere<T>>(&shape.kind))
    return Vec3<T>::Constant(ball->radius);
  if (const auto* ellipsoid = std::get_if<Ellipsoid<T>>(&shape.kind)) return ellipsoid->radii;
  return Vec3<T>::Zero();
}

}  // namespace detail

/// The sum of a box and an ellipsoid as an affine image of a rounded box, which solvers support
/// better; nothing for other shapes. Half the box's sizes by the radii are rounded once. Rounding
/// of the image, as far as it is relative to size, is that of the rounded box times the
/// ellipsoid's proportions, so those beyond 1:4 are left as they are; sizes beyond 2^+-16 as well.
template <class T>
std::optional<Shape<T>> as_rounded_box(const Shape<T>& shape) {
  constexpr T most_slender = T(4), largest = T(0x1p16);
  const auto* sum = std::get_if<MinkowskiSum<T>>(&shape.kind);
  if (!sum || sum->shapes.size() != 2) return {};
  const Shape<T>&first = *sum->shapes[0], &second = *sum->shapes[1];
  const auto* box = std::get_if<Box<T>>(&first.kind);
  const Vec3<T> radii = detail::radii_of(box ? second : first);
  if (!box) box = std::get_if<Box<T>>(&second.kind);
  const T least = radii.minCoeff(), most = radii.maxCoeff();
  if (!box || !(least >= T(1) / largest) || !(most <= largest) || most > most_slender * least)
    return {};
  if (least == most) return Shape<T>(Rounded<T>{most, Nested<T>(Shape<T>(*box))});
  const Box<T> in_radii{box->half_extents.cwiseQuotient(radii)};
  if (!(in_radii.half_extents.maxCoeff() <= largest)) return {};
  return Shape<T>(Transform<T>{Nested<T>(Shape<T>(Rounded<T>{T(1), Nested<T>(Shape<T>(in_radii))})),
                               Affine<T>{Mat3<T>(radii.asDiagonal()), {T(0), T(0), T(0)}}});
}

}  // namespace minkray
