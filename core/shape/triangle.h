// SPDX-License-Identifier: MIT
// A flat triangle with its interior; the corners may be collinear or coincide.
#pragma once

#include <array>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Triangle {
  std::array<Vec3<double>, 3> points = {Vec3<double>::Zero(), Vec3<double>::Zero(),
                                        Vec3<double>::Zero()};

  static constexpr std::string_view name = "triangle";
  static constexpr std::string_view doc = "A flat triangle.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"points", &Triangle::points, Unit::length, Range::any, "its three corners"}};
  }

  /// Returns the first of points that are equally far along n.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> a = widen<W>(points[0]), b = widen<W>(points[1]), c = widen<W>(points[2]);
    const Vec3<W> ab = select<W>(n.dot(b - a) > W(0), b, a);
    return select<W>(n.dot(c - ab) > W(0), c, ab);
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

}  // namespace minkray
