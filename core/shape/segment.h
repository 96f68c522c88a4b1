// SPDX-License-Identifier: MIT
// A straight segment between two points, which may coincide.
#pragma once

#include <array>

#include "core/math/vec.h"
#include "core/support/exact_form.h"
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

  /// Closed form for rounded segments; casts at plain segments do not use it.
  ExactForm exact_form() const {
    const Vec3<double>&a = points[0], &b = points[1];
    const Vec3<double> half = (b - a) / 2, middle = a + half;
    return {
        FormKind::segment, {half.x(), half.y(), half.z(), 0}, {middle.x(), middle.y(), middle.z()}};
  }

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
