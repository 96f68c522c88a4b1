// SPDX-License-Identifier: MIT
// A box around the origin with faces parallel to the coordinate planes; flat if an extent is zero.
#pragma once

#include "core/math/vec.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Box {
  Vec3<double> half_extents = Vec3<double>::Ones();

  static constexpr std::string_view name = "box";
  static constexpr std::string_view doc = "A box around the origin.";
  static constexpr Declared declared = {.slabs = true};
  static constexpr auto fields() {
    return std::tuple{Field{"half_extents", &Box::half_extents, Unit::length, Range::not_negative,
                            "half its size along x, y and z"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> h = widen<W>(half_extents);
    return {select(n.x() < W(0), W(-h.x()), h.x()), select(n.y() < W(0), W(-h.y()), h.y()),
            select(n.z() < W(0), W(-h.z()), h.z())};
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

}  // namespace minkray
