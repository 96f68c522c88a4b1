// SPDX-License-Identifier: MIT
// Shapes that are measured, as Minkray's and as triangles.
#pragma once

#include <string>
#include <vector>

#include "mesh.h"

namespace bench {

/// A shape around the origin.
struct Body {
  std::string name;
  mk::Shape shape;
  MeshMaker mesh_of_steps;
  double radius;  ///< distance of its furthest point from the origin

  /// Triangles whose error is at most `relative_error` times the radius; flat shapes are exact.
  Mesh mesh(double relative_error) const;
};

Body sphere(double radius);
Body ellipsoid(const Vec& radii);
Body box(const Vec& half_extents);
Body rounded_box(const Vec& half_extents, double radius);
Body capsule(double radius, double half_height);
Body cylinder(double radius, double half_height);
Body cone(double radius, double half_height);
Body hull(const std::vector<Vec>& points);

/// Points of an ellipsoid; all of them are vertices of their hull.
std::vector<Vec> random_points(int count, const Vec& radii, std::uint64_t seed);

}  // namespace bench
