// SPDX-License-Identifier: MIT
// The convex hull of shapes.
#pragma once

#include "core/math/vec.h"
#include "core/support/field.h"
#include "core/support/jet.h"
#include "core/support/nested.h"

namespace minkray {

struct HullOf {
  ShapeList shapes;

  static constexpr std::string_view name = "hull_of";
  static constexpr std::string_view doc = "The convex hull of shapes.";
  static constexpr auto fields() {
    return std::tuple{
        Field{"shapes", &HullOf::shapes, Unit::none, Range::any, "one shape or more"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    Vec3<W> best = shapes.front().support(n);
    for (std::size_t i = 1; i < shapes.size(); ++i) {
      const Vec3<W> candidate = shapes[i].support(n);
      best = select<W>(n.dot(candidate - best) > W(0), candidate, best);
    }
    return best;
  }

  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    Jet<W> best = shapes.front().jet(n);
    W furthest = best.support_function(n);
    for (std::size_t i = 1; i < shapes.size(); ++i) {
      const Jet<W> candidate = shapes[i].jet(n);
      const W along = candidate.support_function(n);
      const auto further = along > furthest;
      best = select<W>(further, candidate, best);
      furthest = select(further, along, furthest);
    }
    return best;
  }
};

}  // namespace minkray
