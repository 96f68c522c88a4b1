// SPDX-License-Identifier: MIT
// Two triangles in one frame: their nearest points in closed form, the plane between them that
// proves the distance, and whether they surely cross.
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

using TriangleCorners = std::array<Vec3<double>, 3>;

/// `lower` is the gap that planes across the normal leave, `upper` the distance of the points; no
/// rounding is allowed for. Of triangles that cross lower is 0 or less, and so it may be of
/// slivers, of which the closed form has too few digits.
struct TriangleGap {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  Vec3<double> point_a = Vec3<double>::Zero(), point_b = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::Zero();  ///< from a to b
};
TriangleGap triangle_gap(const TriangleCorners& a, const TriangleCorners& b);

/// How far the triangle reaches along a vector.
inline double reach_along(const TriangleCorners& triangle, const Vec3<double>& n) {
  return std::max({n.dot(triangle[0]), n.dot(triangle[1]), n.dot(triangle[2])});
}

/// The gap between two planes across the unit vector n that have a and b on their sides.
double gap_along(const TriangleCorners& a, const TriangleCorners& b, const Vec3<double>& n);

/// True if an edge of one passes through the other, even with each corner moved by `loss`. Then a
/// point that is on both, or within the loss of it, is in `common`.
bool surely_cross(const TriangleCorners& a, const TriangleCorners& b, double loss,
                  Vec3<double>& common);

}  // namespace minkray
