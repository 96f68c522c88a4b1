// SPDX-License-Identifier: MIT
// Rewrites the Minkowski sum of a box and an ellipsoid along the same axes as an affine image of a
// rounded box: in units of the ellipsoid's radii, the ellipsoid is a unit ball.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace minkray {

namespace detail {

/// Radii of a sphere or an ellipsoid; zero for other shapes.
inline Vec3<double> radii_of(const Shape& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape.kind))
    return Vec3<double>::Constant(ball->radius);
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape.kind)) return ellipsoid->radii;
  return Vec3<double>::Zero();
}

}  // namespace detail

/// Returns the sum of a box and an ellipsoid as an affine image of a rounded box, which solvers
/// support better. Returns nothing for other shapes. Also returns nothing for sizes outside 2^-16
/// to 2^16, and for ellipsoids whose radii differ by more than a factor of 4, since the map
/// multiplies rounding errors by this ratio.
inline std::optional<Shape> as_rounded_box(const Shape& shape) {
  constexpr double most_slender = 4.0, largest = 0x1p16;
  const auto* sum = std::get_if<MinkowskiSum>(&shape.kind);
  if (!sum || sum->shapes.size() != 2) return {};
  const Shape &first = *sum->shapes[0], &second = *sum->shapes[1];
  const auto* box = std::get_if<Box>(&first.kind);
  const Vec3<double> radii = detail::radii_of(box ? second : first);
  if (!box) box = std::get_if<Box>(&second.kind);
  const double least = radii.minCoeff(), most = radii.maxCoeff();
  if (!box || !(least >= 1.0 / largest) || !(most <= largest) || most > most_slender * least)
    return {};
  if (least == most) return Shape(Rounded{most, Nested(Shape(*box))});
  const Box in_radii{box->half_extents.cwiseQuotient(radii)};
  if (!(in_radii.half_extents.maxCoeff() <= largest)) return {};
  return Shape(Transform{Nested(Shape(Rounded{1.0, Nested(Shape(in_radii))})),
                         Affine<double>{Mat3<double>(radii.asDiagonal()), {0.0, 0.0, 0.0}}});
}

}  // namespace minkray
