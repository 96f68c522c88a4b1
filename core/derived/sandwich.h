// SPDX-License-Identifier: MIT
// Two meshes made from a shape's support mapping alone: a ray meets the outer mesh no later than
// the shape, and the shape no later than the inner one. Inner: the hull of support points. Outer:
// the intersection of the half-spaces that those supports bound. Polytopes are exact: half of the
// directions are facet normals of the hull of the other half's supports.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/shape/shape.h"

namespace minkray {

struct Mesh {
  std::vector<Vec3<double>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

struct SandwichOptions {
  /// Number of quasi-uniform directions to begin with.
  int directions = 500;
  /// Least distance of the outer mesh outside of the shape, and of the inner one within it, in
  /// units of the frame: room for the rounding of programs that read the meshes.
  double margin = 0x1p-20;
  /// Shapes thinner than this, relative to their size, count as flat.
  double flatness = 0x1p-20;
};

/// The meshes are in `frame`, where the shape spans about [-1, 1] along every axis of its rank, and
/// a ray keeps its parameter (frames are affine).
///
/// frame.rank 3: closed surfaces. Rank 2 (disks, triangles, flat hulls): polygons in the shape's
/// plane, `outer` not around the shape but around it within the plane, so that both halves apply,
/// and both give the same parameter. Rank 1 and 0 (segments, points): no surface fits in, `inner`
/// is empty; `outer` is a box that is `margin` wide, whose misses must be misses.
struct Sandwich {
  RoundFrame frame;
  Vec3<double> centre;  ///< a point well inside, in the frame
  Mesh inner, outer;

  int rank() const { return frame.rank; }
};

/// Throws std::runtime_error if Qhull fails.
Sandwich sandwich_of(const Shape& shape, const SandwichOptions& options = {});

/// n directions spread evenly over the unit sphere: a Fibonacci spiral.
std::vector<Vec3<double>> even_directions(int n);

}  // namespace minkray
