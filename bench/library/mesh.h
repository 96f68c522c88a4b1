// SPDX-License-Identifier: MIT
// Triangle meshes inside convex shapes, as coarse as an error allows. Vertices lie on the surface;
// the error is the largest distance from a triangle's plane to the parallel tangent plane, which
// Shape::support gives, so that no formula of the mesh is trusted.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "vec.h"

namespace bench {

struct Mesh {
  std::vector<Vec> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  double error = 0;                                     ///< as measured, a length
};

/// Makes a mesh of a number of steps; more steps are finer.
using MeshMaker = std::function<Mesh(int)>;

/// A ball of radius `r` around every point of a box: spheres, capsules, boxes and rounded boxes,
/// as extents and `r` may be 0. `steps` triangles lie along a quarter of a circle.
Mesh mesh_of_rounded_box(const Vec& half_extents, double r, int steps);
/// Around the z axis. A frustum: `r_above` 0 makes a cone.
Mesh mesh_of_frustum(double r_below, double r_above, double half_height, int sides);
/// The convex hull of points in general position.
Mesh mesh_of_hull(const std::vector<Vec>& points);

/// The mesh of fewest steps whose measured error is at most `error`. Throws std::runtime_error if a
/// mesh is not closed or not inside the shape.
Mesh coarsest(const MeshMaker& make, const mk::Shape& shape, double error);

}  // namespace bench
