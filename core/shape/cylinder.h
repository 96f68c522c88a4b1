// SPDX-License-Identifier: MIT
// A cylinder around the z axis, from -half_height to +half_height.
#pragma once

#include "core/shape/disk.h"
#include "core/support/jet.h"

namespace minkray {

struct Cylinder {
  double radius = 1.0;
  double half_height = 1.0;

  static constexpr std::string_view name = "cylinder";
  static constexpr std::string_view doc = "A cylinder around the z axis.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Cylinder::radius, Unit::length, Range::positive, "its radius"},
        Field{"half_height", &Cylinder::half_height, Unit::length, Range::not_negative,
              "half its height: the caps are at z = -half_height and +half_height"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    Vec3<W> s = unit_disk_support(n) * W(radius);
    s.z() = select(n.z() < W(0), W(-half_height), W(half_height));
    return s;
  }

  template <class W>
  AxialDiskJet<W> jet(const Vec3<W>& n) const {
    return {select(n.z() < W(0), W(-half_height), W(half_height)), W(radius)};
  }
};

}  // namespace minkray
