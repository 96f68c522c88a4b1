// SPDX-License-Identifier: MIT
// Tables for walks over a polytope: rows of numbers that the lanes of a packet gather. A half-edge
// is an edge of one triangle; its twin is the same edge of the neighbouring triangle. Links are
// indices of half-edges, stored as numbers. Triangle f has the half-edges 3 f, 3 f + 1 and 3 f + 2,
// counter-clockwise from outside.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/cube_map.h"
#include "core/polytope/plane_rows.h"

namespace minkray::exact {

struct PolytopeTables {
  /// One row per vertex: its position, and a number that fills the row.
  static constexpr std::size_t vertex_row = 4;
  std::vector<double> vertices;

  /// One row per half-edge: the opposite corner of the triangle beyond the edge, and the half-edge
  /// that follows the twin, with a minus sign if that half-edge is the last of its triangle.
  static constexpr std::size_t walk_row = 4;
  std::vector<double> walk;
  std::vector<std::int32_t> links;  ///< copy of the fourth column of `walk`

  /// One row per half-edge: its origin (3 numbers), the next half-edge; a unit vector into the
  /// triangle, perpendicular to the edge (3), the twin; the unit vector along the edge (3), the
  /// edge's length. Empty if the polytope is not rounded.
  static constexpr std::size_t feature_row = 12;
  std::vector<double> features;

  /// One row per plane: normal, offset, depth, and three numbers that fill the row.
  static constexpr std::size_t plane_row = 8;
  std::vector<double> planes;

  PlaneRows scanned;                    ///< the planes, stored for scans with a single line
  std::vector<std::uint32_t> origin;    ///< vertex of each half-edge
  std::vector<std::uint32_t> plane_of;  ///< plane of each half-edge
  CubeMap directions{1};
  std::vector<std::uint32_t> facing;  ///< for each cell of normals, a triangle's first half-edge

  double rounded_by = 0;                ///< the radius by which the polytope is grown
  Vec3<double> inner = {0, 0, 0};       ///< a point clearly inside
  Vec3<double> by_extents = {1, 1, 1};  ///< 1 / half extents, grown by the radius

  std::size_t plane_count() const { return scanned.size(); }
};

}  // namespace minkray::exact
