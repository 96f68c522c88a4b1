// SPDX-License-Identifier: MIT
// A straight segment between two points, which may coincide.
#pragma once

#include <array>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Segment {
  std::array<Vec3<double>, 2> points = {Vec3<double>::Zero(), Vec3<double>::Zero()};

  static constexpr std::string_view name = "segment";
  static constexpr std::string_view doc = "The straight segment between two points.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"points", &Segment::points, Unit::length, Range::any, "its two end points"}};
  }

  /// Returns the first of points that are equally far along n.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> a = widen<W>(points[0]), b = widen<W>(points[1]);
    return select<W>(n.dot(b - a) > W(0), b, a);
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

}  // namespace minkray
