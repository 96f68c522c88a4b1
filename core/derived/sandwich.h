// SPDX-License-Identifier: MIT
// Makes two meshes from a shape's support mapping alone. A ray meets the outer mesh no later than
// the shape, and the shape no later than the inner mesh. The inner mesh is the hull of support
// points, the outer one the intersection of the half-spaces they bound. Half of the directions are
// spread evenly; the others are the facet normals of the hull of the first half's support points,
// so that polytopes are exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/shape/shape.h"

namespace minkray {

/// A closed surface, or a flat polygon, of triangles.
struct Mesh {
  std::vector<Vec3<double>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

struct SandwichOptions {
  /// Number of quasi-uniform directions to begin with.
  int directions = 500;
  /// Least distance of both meshes from the surface of the shape, in units of the frame. Allows for
  /// the rounding of programs that read the meshes.
  double margin = 0x1p-20;
  /// Shapes thinner than this, relative to their size, count as flat.
  double flatness = 0x1p-20;
};

/// The meshes are in `frame`, where the shape spans about [-1, 1] along each of the first `rank`
/// axes. The frame is affine, so the parameter t of a ray is the same in the frame and outside.
///
/// Rank 3: both meshes are closed surfaces. Rank 2 (disks, triangles, flat hulls): both are
/// polygons in the plane of the shape, so a ray has the same t in both; in that plane, `outer`
/// contains the shape. Rank 1 or 0 (segments, points): `inner` is empty, since no surface fits
/// inside; `outer` is a box of width `margin`, and rays that miss the box must miss the shape.
struct Sandwich {
  RoundFrame frame;
  Vec3<double> centre;  ///< a point well inside the shape, in the frame
  Mesh inner, outer;

  int rank() const { return frame.rank; }
};

/// Throws std::runtime_error if Qhull fails.
Sandwich sandwich_of(const Shape& shape, const SandwichOptions& options = {});

/// n directions spread evenly over the unit sphere: a Fibonacci spiral.
std::vector<Vec3<double>> even_directions(int n);

}  // namespace minkray
