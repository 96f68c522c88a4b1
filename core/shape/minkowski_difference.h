// SPDX-License-Identifier: MIT
// The configuration space obstacle A - B: all differences a - b of a point of A and a point of B.
// If B is moved along a ray from the origin, B first touches A at the ray parameter t at which the
// ray hits the obstacle.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"
#include "core/support/nested.h"

namespace minkray {

struct MinkowskiDifference {
  Nested a;
  Nested b;

  static constexpr std::string_view name = "minkowski_difference";
  static constexpr std::string_view doc =
      "The configuration space obstacle A - B: all differences of a point of A and one of B.";
  static constexpr auto fields() {
    return std::tuple{Field{"a", &MinkowskiDifference::a, Unit::none, Range::any, "A"},
                      Field{"b", &MinkowskiDifference::b, Unit::none, Range::any, "B"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return a.support(n) - b.support(Vec3<W>(-n));
  }

  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    const Jet<W> mirrored = b.jet(Vec3<W>(-n));
    return add<W>(a.jet(n),
                  {Vec3<W>(-mirrored.c), mirrored.F, mirrored.exact, Vec3<W>(-mirrored.s)}, n);
  }
};

}  // namespace minkray
