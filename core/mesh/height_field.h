// SPDX-License-Identifier: MIT
// A terrain: heights over a grid, two triangles in each cell.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// The grid's middle is above the origin. Rows follow each other along y, columns along x.
struct HeightField {
  std::span<const double> heights;  ///< row by row, the row of the least y first
  std::size_t rows = 0, columns = 0;
  double size_x = 1;  ///< distance from the first to the last column
  double size_y = 1;  ///< distance from the first to the last row
  /// If set, walls and a bottom at this z close the terrain to a solid.
  std::optional<double> bottom = {};
};

/// Makes the terrain's mesh. The triangles of the cell in row r and column c have the numbers i = 2
/// (r (columns - 1) + c) and i + 1. The edge between the two goes from the cell's corner of least x
/// and y to that of greatest x and y. The triangles of walls and bottom have the numbers after
/// those of all cells. Throws std::invalid_argument unless there are at least two rows and columns,
/// all numbers are finite, sizes are above 0 and the bottom is below all heights.
std::shared_ptr<const TriangleMesh> mesh_of(const HeightField& field);

}  // namespace minkray
