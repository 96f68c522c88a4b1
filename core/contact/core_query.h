// SPDX-License-Identifier: MIT
// A distance that is being searched for: two cores, when the search may end, and what has been
// found so far. What looks for it in several ways (GJK, sliding features, flat ends) shares it.
#pragma once

#include "core/contact/core_pair.h"

namespace minkray {

/// Points this near to each other, in sizes, are common.
inline constexpr double common_point = 1e-15;

template <CoreKind A, CoreKind B>
struct CoreQuery {
  const CorePair& pair;
  const CoreSearch& search;
  double size = pair.size();
  double gap = search.gap * size;  ///< bounds this near to each other have met
  CoreDistance result = {};

  DifferencePoint nearest(const Vec3<double>& d) {
    ++result.supports;
    return nearest_along<A, B>(pair, d);
  }

  /// The answer is this point of A, and c from it. Always true.
  bool end_at(CoreStatus status, const Vec3<double>& a, const Vec3<double>& c) {
    result.status = status;
    result.a = a;
    result.c = c;
    result.upper = c.norm();
    if (status == CoreStatus::overlapping && result.lower > 0) {
      result.status = CoreStatus::unsettled;
      result.upper = std::numeric_limits<double>::infinity();
    }
    return true;
  }
};

}  // namespace minkray
