// SPDX-License-Identifier: MIT
// A capsule along the z axis: all points within `radius` of a segment.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Capsule {
  double radius = 1.0;
  double half_height = 1.0;

  static constexpr std::string_view name = "capsule";
  static constexpr std::string_view doc =
      "A capsule along the z axis: a segment with a ball swept along it.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Capsule::radius, Unit::length, Range::positive, "the radius of its balls"},
        Field{"half_height", &Capsule::half_height, Unit::length, Range::not_negative,
              "half its segment's length: the balls' centres are at z = -half_height and "
              "+half_height"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    Vec3<W> s = unit(n) * W(radius);
    s.z() += select(n.z() < W(0), W(-half_height), W(half_height));
    return s;
  }

  template <class W>
  AxialBallJet<W> jet(const Vec3<W>& n) const {
    return {select(n.z() < W(0), W(-half_height), W(half_height)), W(radius)};
  }
};

}  // namespace minkray
