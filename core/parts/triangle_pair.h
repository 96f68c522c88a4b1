// SPDX-License-Identifier: MIT
// Two triangles in one frame: their nearest points in closed form, the plane between them that
// proves the distance, and a test that proves that they cross.
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

using TriangleCorners = std::array<Vec3<double>, 3>;

/// Bounds without a margin for rounding: `lower` is the gap between planes perpendicular to the
/// normal, `upper` the distance of the points. `lower` is 0 or less if the triangles cross. This
/// may also happen for slivers, for which the closed form has too few digits.
struct TriangleGap {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  Vec3<double> point_a = Vec3<double>::Zero(), point_b = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::Zero();  ///< from a to b
};
TriangleGap triangle_gap(const TriangleCorners& a, const TriangleCorners& b);

/// Largest n . p over the triangle's points p.
inline double reach_along(const TriangleCorners& triangle, const Vec3<double>& n) {
  return std::max({n.dot(triangle[0]), n.dot(triangle[1]), n.dot(triangle[2])});
}

/// Gap between two planes perpendicular to the unit vector n, with a and b on their outer sides.
double gap_along(const TriangleCorners& a, const TriangleCorners& b, const Vec3<double>& n);

/// True if an edge of one triangle passes through the other, and still does if each corner moves by
/// up to `loss`. `common` is then within `loss` of a point of both triangles.
bool surely_cross(const TriangleCorners& a, const TriangleCorners& b, double loss,
                  Vec3<double>& common);

}  // namespace minkray
