// SPDX-License-Identifier: MIT
// Warm start: the final state of a query on a pair of bodies, which the caller passes to the next
// query. Contains the separating axis (G. van den Bergen, "Ray Casting against General Convex
// Objects", 2004, section 4) and the features of the nearest points. The state only sets where a
// search starts. Results are therefore proven for any contents, even those of another pair.
#pragma once

#include <cstdint>

#include "core/derived/core_and_radius.h"

namespace minkray {

struct PairMemory {
  /// Axis of the last result, in the frame of the first core; zero: none.
  Vec3<double> axis = Vec3<double>::Zero();
  /// Features that the nearest points lie on, of the first core and of the second.
  std::int32_t feature_a[4] = {}, feature_b[4] = {};
  std::int32_t count = 0;

  /// True unless the axis is zero or NaN.
  bool has_axis() const {
    constexpr double near_one = 1e-6;
    return std::abs(axis.squaredNorm() - 1) < near_one;
  }
};

/// True if `feature` is the number of a feature of the core.
inline bool is_feature_of(const ShapeCore& core, std::int32_t feature) {
  switch (core.kind) {
    case CoreKind::point:
    case CoreKind::ellipsoid:
      return feature == 0;
    case CoreKind::segment:
    case CoreKind::disks:
      return feature == 0 || feature == 1;
    case CoreKind::box:
      return feature >= 0 && feature < 8;
    case CoreKind::hull:
      return feature >= 0 && feature < core.count;
    case CoreKind::other:
      break;
  }
  return false;
}

}  // namespace minkray
