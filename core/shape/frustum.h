// SPDX-License-Identifier: MIT
// A frustum (truncated cone) around the z axis.
#pragma once

#include <array>

#include "core/shape/disk.h"
#include "core/support/jet.h"

namespace minkray {

struct Frustum {
  std::array<double, 2> radii = {1.0, 1.0};
  double half_height = 1.0;

  static constexpr std::string_view name = "frustum";
  static constexpr std::string_view doc = "A cone around the z axis, cut off by two disks.";
  static constexpr auto fields() {
    return std::tuple{Field{"radii", &Frustum::radii, Unit::length, Range::not_negative,
                            "the disks' radii: at z = -half_height, at z = +half_height"},
                      Field{"half_height", &Frustum::half_height, Unit::length, Range::not_negative,
                            "half its height"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> rim = unit_disk_support(n);
    const auto upper = is_upper(n, rim);
    Vec3<W> s = rim * select(upper, W(radii[1]), W(radii[0]));
    s.z() = select(upper, W(half_height), W(-half_height));
    return s;
  }

  template <class W>
  AxialDiskJet<W> jet(const Vec3<W>& n) const {
    const auto upper = is_upper<W>(n, unit_disk_support(n));
    return {select(upper, W(half_height), W(-half_height)),
            select(upper, W(radii[1]), W(radii[0]))};
  }

 private:
  /// True if the upper disk reaches further along n; `rim` is the unit disk's support point.
  template <class W>
  auto is_upper(const Vec3<W>& n, const Vec3<W>& rim) const {
    return n.z() * W(2.0 * half_height) + n.dot(rim) * W(radii[1] - radii[0]) > W(0);
  }
};

}  // namespace minkray
