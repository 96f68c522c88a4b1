// SPDX-License-Identifier: MIT
// The Minkowski sum of a shape with a ball: the shape grown by a radius, with rounded edges.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"
#include "core/support/nested.h"

namespace minkray {

struct Rounded {
  double radius = 0.0;
  Nested shape;

  static constexpr std::string_view name = "rounded";
  static constexpr std::string_view doc =
      "A shape grown by a radius: its Minkowski sum with a ball.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Rounded::radius, Unit::length, Range::not_negative,
              "the radius by which the shape grows"},
        Field{"shape", &Rounded::shape, Unit::none, Range::any, "the shape to round"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return shape.support(n) + unit(n) * W(radius);
  }

  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    return add<W>(shape.jet(n), AxialBallJet<W>{W(0), W(radius)}, n);
  }
};

}  // namespace minkray
