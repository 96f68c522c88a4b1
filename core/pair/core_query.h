// SPDX-License-Identifier: MIT
// A distance search: two cores, the criteria for the end of the search, and the best result so far.
// Shared by all search methods (GJK, sliding features, flat ends).
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

/// Points of A and B that are this close, relative to the size, count as one common point.
inline constexpr double common_point = 1e-15;

template <CoreKind A, CoreKind B>
struct CoreQuery {
  const CorePair& pair;
  const CoreSearch& search;
  double size = pair.size();       ///< to which tolerances are relative
  double gap = search.gap * size;  ///< the search ends if the bounds differ by at most this
  CoreDistance result = {};

  DifferencePoint nearest(const Vec3<double>& d) {
    ++result.supports;
    return nearest_along<A, B>(pair, d);
  }

  /// Sets the final result: the nearest point a of A, and the vector c from a to the nearest point
  /// of B. Returns true, so that callers can return it.
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
