// SPDX-License-Identifier: MIT
// A single point.
#pragma once

#include "core/math/vec.h"
#include "core/support/exact_form.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Point {
  Vec3<double> position = Vec3<double>::Zero();

  static constexpr std::string_view name = "point";
  static constexpr std::string_view doc = "A single point; with a radius around it, a ball.";
  static constexpr auto fields() {
    return std::tuple{Field{"position", &Point::position, Unit::length, Range::any,
                            "the point's position", true}};
  }

  /// A ball of radius 0, so that a rounded point has the closed form of a ball.
  ExactForm exact_form() const {
    const Vec3<double>& p = position;
    return {FormKind::ball, {0}, {double(p[0]), double(p[1]), double(p[2])}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>&) const {
    return widen<W>(position);
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>&) const {
    return {widen<W>(position)};
  }
};

}  // namespace minkray
