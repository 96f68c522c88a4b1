// SPDX-License-Identifier: MIT
// The ellipsoids that a shape is the Minkowski sum of, if it is: sums and differences of ellipsoids
// and balls, turned and moved and grown.
#pragma once

#include <array>

#include "core/shape/shape.h"

namespace minkray {

/// A point and the ellipsoids { F b : |b| <= 1 }, to be added.
template <class T>
struct EllipsoidTerms {
  static constexpr std::size_t most = 4;
  Vec3<T> centre = Vec3<T>::Zero();
  std::size_t count = 0;
  std::array<Mat3<T>, most> F;
};

namespace detail {

/// Adds the terms of shape's image under the linear map. False if it has others, or too many.
template <class T>
bool add_terms(const Shape<T>& shape, const Mat3<T>& linear, EllipsoidTerms<T>& terms) {
  const auto add = [&](const auto& factor) {
    if (terms.count == terms.most) return false;
    terms.F[terms.count++] = factor;
    return true;
  };
  return std::visit(
      [&]<class S>(const S& kind) {
        if constexpr (std::is_same_v<S, Ellipsoid<T>>) {
          return add(linear * kind.radii.asDiagonal());
        } else if constexpr (std::is_same_v<S, Sphere<T>>) {
          return add(linear * kind.radius);
        } else if constexpr (std::is_same_v<S, Point<T>>) {
          terms.centre += linear * kind.position;
          return true;
        } else if constexpr (std::is_same_v<S, Rounded<T>>) {
          return add_terms(*kind.shape, linear, terms) &&
                 (kind.radius == T(0) || add(linear * kind.radius));
        } else if constexpr (std::is_same_v<S, MinkowskiSum<T>>) {
          for (const auto& term : kind.shapes)
            if (!add_terms(*term, linear, terms)) return false;
          return true;
        } else if constexpr (std::is_same_v<S, MinkowskiDifference<T>>) {
          return add_terms(*kind.a, linear, terms) && add_terms(*kind.b, Mat3<T>(-linear), terms);
        } else if constexpr (std::is_same_v<S, Transform<T>>) {
          const Affine<T>& map = kind.map.affine();
          terms.centre += linear * map.translation;
          return add_terms(*kind.shape, Mat3<T>(linear * map.linear), terms);
        } else {
          return false;
        }
      },
      shape.kind);
}

}  // namespace detail

/// None (count 0) if the shape is no such sum.
template <class T>
EllipsoidTerms<T> ellipsoid_terms(const Shape<T>& shape) {
  EllipsoidTerms<T> terms;
  if (!detail::add_terms(shape, Mat3<T>(Mat3<T>::Identity()), terms)) terms.count = 0;
  return terms;
}

}  // namespace minkray
