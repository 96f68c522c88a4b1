// SPDX-License-Identifier: MIT
// A shape under an invertible affine map: translated, rotated, scaled, sheared, mirrored.
#pragma once

#include "core/support/affine_map.h"
#include "core/support/field.h"
#include "core/support/jet.h"
#include "core/support/nested.h"

namespace minkray {

struct Transform {
  Nested shape;
  AffineMap map;

  static constexpr std::string_view name = "transform";
  static constexpr std::string_view doc =
      "A shape moved, turned, scaled, sheared or mirrored by an invertible affine map.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"shape", &Transform::shape, Unit::none, Range::any, "the shape to transform"},
        Field{"map", &Transform::map, Unit::length, Range::any,
              "\"translate\" [x,y,z], \"rotate\" [x,y,z,w] (quaternion) and \"scale\" (a number or "
              "three, applied first), each optional; or \"matrix\": three rows of three or four"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return map(shape.support(map.inner_direction(n)));
  }

  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    const Jet<W> inner = shape.jet(map.inner_direction(n));
    return {map(inner.c), mapped_factor<W>(inner.F), inner.exact, map(inner.s)};
  }

  /// Maps the factor F of a jet's ellipsoid. A ball stays a ball if the map scales all lengths
  /// equally.
  template <class W>
  Mat3<W> mapped_factor(const Mat3<W>& F) const {
    Mat3<W> mapped = widen<W, double>(map.affine().linear) * F;
    if (map.similarity() > 0.0) {
      // Decides for each lane separately, so that no lane depends on the others.
      const Mat3<W> ball = Mat3<W>::Identity() * F(0, 0);
      const Mask<W> is_ball = (F - ball).cwiseAbs().sum() == W(0);
      const Mat3<W> scaled = ball * W(map.similarity());
      for (int j = 0; j < 3; ++j)
        mapped.col(j) = select<W>(is_ball, Vec3<W>(scaled.col(j)), Vec3<W>(mapped.col(j)));
    }
    return mapped;
  }
};

}  // namespace minkray
