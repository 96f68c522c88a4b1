// SPDX-License-Identifier: MIT
// An ellipsoid with its axes along the coordinate axes.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Ellipsoid {
  Vec3<double> radii = Vec3<double>::Ones();

  static constexpr std::string_view name = "ellipsoid";
  static constexpr std::string_view doc = "An ellipsoid around the origin.";
  static constexpr auto fields() {
    return std::tuple{Field{"radii", &Ellipsoid::radii, Unit::length, Range::positive,
                            "its radii along x, y and z"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> r = widen<W>(radii);
    return unit<W>(n.cwiseProduct(r)).cwiseProduct(r);
  }

  template <class W>
  AxialEllipsoidJet<W> jet(const Vec3<W>&) const {
    return {widen<W>(radii)};
  }
};

}  // namespace minkray
