// SPDX-License-Identifier: MIT
// A ball around the origin.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Sphere {
  double radius = 1.0;

  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view doc = "A ball around the origin.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Sphere::radius, Unit::length, Range::positive, "its radius"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return unit(n) * W(radius);
  }

  template <class W>
  AxialBallJet<W> jet(const Vec3<W>&) const {
    return {W(0), W(radius)};
  }
};

}  // namespace minkray
