// SPDX-License-Identifier: MIT
// Finds the corners of a face of a hull, as a polygon in the face's plane, relative to a point of
// the face.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/pair/core_support.h"

namespace minkray {

/// Polar and Cartesian coordinates about the point, in the plane perpendicular to the normal.
struct PlaneCorner {
  double angle, x, y;
};

/// Returns the hull's points for which takes(height) is true, where `height` is measured along n
/// from the given point. The points are not sorted, and their angles are not set. The list is valid
/// until the next call in the same thread.
template <class Takes>
std::vector<PlaneCorner>& face_corners(const ShapeCore& core, const Vec3<double>& point,
                                       const Vec3<double>& n, const Takes& takes) {
  const Vec3<double> u = n.unitOrthogonal(), v = n.cross(u);
  thread_local std::vector<PlaneCorner> corners;
  corners.clear();
  for (int i = 0; i < core.count; ++i) {
    const Vec3<double> to = Vec3<double>(core.x[i], core.y[i], core.z[i]) - point;
    if (takes(n.dot(to))) corners.push_back({0, u.dot(to), v.dot(to)});
  }
  return corners;
}

/// Sorts the corners by their angle around the point.
inline void sort_round(std::vector<PlaneCorner>& corners) {
  for (PlaneCorner& corner : corners) corner.angle = std::atan2(corner.y, corner.x);
  std::ranges::sort(corners, {}, &PlaneCorner::angle);
}

/// Largest distance of a face's corners from the face's plane that rounding can cause, relative to
/// the size.
inline constexpr double flat_face = 1e-12;

}  // namespace minkray
