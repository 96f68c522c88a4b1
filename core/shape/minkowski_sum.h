// SPDX-License-Identifier: MIT
// The Minkowski sum of shapes: all sums of one point of each shape.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"
#include "core/support/nested.h"

namespace minkray {

struct MinkowskiSum {
  ShapeList shapes;

  static constexpr std::string_view name = "minkowski_sum";
  static constexpr std::string_view doc = "All sums of one point of each of the shapes.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"shapes", &MinkowskiSum::shapes, Unit::none, Range::any, "one shape or more"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    Vec3<W> s = shapes.front().support(n);
    for (std::size_t i = 1; i < shapes.size(); ++i) s += shapes[i].support(n);
    return s;
  }

  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    Jet<W> sum = shapes.front().jet(n);
    for (std::size_t i = 1; i < shapes.size(); ++i) sum = add<W>(sum, shapes[i].jet(n), n);
    return sum;
  }
};

}  // namespace minkray
