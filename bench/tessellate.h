// SPDX-License-Identifier: MIT
// A triangle mesh inside a convex shape, of a given geometric error: what a triangle ray tracer
// would draw in the shape's place.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/shape/shape.h"

namespace minkray::bench {

struct TriangleMesh {
  std::vector<Vec3<float>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double error =
      0;  ///< the largest distance between a facet and the shape's parallel tangent plane
};

/// Closed; every vertex is a support point. Support points of a regular grid of directions, as one
/// would tessellate by hand: by longitude and latitude, or an octahedron's, whichever takes fewer
/// triangles; the grid is as fine as the error wants it, a length, but no finer than
/// `most_triangles`. Polytopes come out exact; where grids of directions do not follow a shape's
/// edges (rounded hulls) the convex hull of the points is taken.
TriangleMesh tessellate(const Shape& shape, double error, std::size_t most_triangles = 16'000'000);

}  // namespace minkray::bench
