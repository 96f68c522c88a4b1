// SPDX-License-Identifier: MIT
// A cone around the z axis: the apex at z = +half_height, the base disk at z = -half_height.
#pragma once

#include "core/shape/disk.h"
#include "core/support/jet.h"

namespace minkray {

struct Cone {
  double radius = 1.0;
  double half_height = 1.0;

  static constexpr std::string_view name = "cone";
  static constexpr std::string_view doc = "A cone around the z axis, its apex at +z.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Cone::radius, Unit::length, Range::positive, "the radius of its base"},
        Field{"half_height", &Cone::half_height, Unit::length, Range::not_negative,
              "half its height: apex at z = +half_height, base at z = -half_height"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> apex(W(0), W(0), W(half_height));
    Vec3<W> rim = unit_disk_support(n) * W(radius);
    rim.z() = W(-half_height);
    return select<W>(n.dot(apex - rim) > W(0), apex, rim);
  }

  template <class W>
  AxialDiskJet<W> jet(const Vec3<W>& n) const {
    const auto apex = support(n).z() > W(0);
    return {select(apex, W(half_height), W(-half_height)), select(apex, W(0), W(radius))};
  }
};

}  // namespace minkray
