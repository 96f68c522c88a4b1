// SPDX-License-Identifier: MIT
// A round disk without thickness, in the plane z = 0.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

/// Support point of the unit disk in the plane z = 0, usually on the rim. For a direction along z,
/// all points of the disk are support points; returns the centre.
template <class W>
Vec3<W> unit_disk_support(const Vec3<W>& n) {
  return unit<W>({n.x(), n.y(), W(0)});
}

struct Disk {
  double radius = 1.0;

  static constexpr std::string_view name = "disk";
  static constexpr std::string_view doc =
      "A flat round disk around the origin, its normal along z.";
  static constexpr auto fields() {
    return std::tuple{Field{"radius", &Disk::radius, Unit::length, Range::positive, "its radius"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return unit_disk_support(n) * W(radius);
  }

  template <class W>
  AxialDiskJet<W> jet(const Vec3<W>&) const {
    return {W(0), W(radius)};
  }
};

}  // namespace minkray
