// SPDX-License-Identifier: MIT
// A single point.
#pragma once

#include "core/math/vec.h"
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
