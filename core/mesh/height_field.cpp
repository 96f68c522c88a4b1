// SPDX-License-Identifier: MIT
#include "core/mesh/height_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace minkray {
namespace {

constexpr std::size_t most_points = std::size_t{1} << 29;

void check(const HeightField& field) {
  const auto wrong = [](const std::string& what) { throw std::invalid_argument(what); };
  if (field.rows < 2 || field.columns < 2)
    wrong("heights: must be at least two rows and two columns (got " + std::to_string(field.rows) +
          " and " + std::to_string(field.columns) + ")");
  if (field.rows > most_points / field.columns)
    wrong("heights: must be at most 2^29 (got " + std::to_string(field.rows) + " rows and " +
          std::to_string(field.columns) + " columns)");
  if (field.heights.size() != field.rows * field.columns)
    wrong("heights: must be one for each row and column, " +
          std::to_string(field.rows * field.columns) + " (got " +
          std::to_string(field.heights.size()) + ")");
  for (const auto& [name, size] : {std::pair("x", field.size_x), std::pair("y", field.size_y)})
    if (!(size > 0) || !std::isfinite(size))
      wrong(std::string("size along ") + name + ": must be finite and > 0 (got " +
            std::to_string(size) + ")");
  double least = field.heights[0];
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    if (!std::isfinite(field.heights[i]))
      wrong("heights[" + std::to_string(i / field.columns) + "][" +
            std::to_string(i % field.columns) + "]: must be finite");
    least = std::min(least, field.heights[i]);
  }
  if (field.bottom && !(*field.bottom < least && std::isfinite(*field.bottom)))
    wrong("bottom: must be finite and below all heights, of which the least is " +
          std::to_string(least) + " (got " + std::to_string(*field.bottom) + ")");
}

/// The grid's border, counter-clockwise as seen from above.
std::vector<std::uint32_t> border_of(std::uint32_t rows, std::uint32_t columns) {
  std::vector<std::uint32_t> border;
  for (std::uint32_t c = 0; c + 1 < columns; ++c) border.push_back(c);
  for (std::uint32_t r = 0; r + 1 < rows; ++r) border.push_back(r * columns + columns - 1);
  for (std::uint32_t c = columns - 1; c > 0; --c) border.push_back((rows - 1) * columns + c);
  for (std::uint32_t r = rows - 1; r > 0; --r) border.push_back(r * columns);
  return border;
}

}  // namespace

std::shared_ptr<const TriangleMesh> mesh_of(const HeightField& field) {
  check(field);
  const auto rows = static_cast<std::uint32_t>(field.rows),
             columns = static_cast<std::uint32_t>(field.columns);
  // Symmetric: both halves of a side have the same numbers but for the sign.
  const auto along = [](std::uint32_t i, std::uint32_t count, double size) {
    return size * ((2.0 * i - (count - 1.0)) / (2.0 * (count - 1.0)));
  };
  std::vector<Vec3<double>> vertices;
  vertices.reserve(field.heights.size());
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c)
      vertices.emplace_back(along(c, columns, field.size_x), along(r, rows, field.size_y),
                            field.heights[std::size_t{r} * columns + c]);
  std::vector<Corners> triangles;
  triangles.reserve(2 * std::size_t{rows - 1} * (columns - 1));
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t at = r * columns + c, above = at + columns;
      triangles.push_back({at, at + 1, above + 1});
      triangles.push_back({at, above + 1, above});
    }
  if (field.bottom) {
    const std::vector<std::uint32_t> border = border_of(rows, columns);
    const auto first = static_cast<std::uint32_t>(vertices.size()),
               count = static_cast<std::uint32_t>(border.size());
    for (const std::uint32_t i : border)
      vertices.emplace_back(vertices[i].x(), vertices[i].y(), *field.bottom);
    const std::uint32_t middle = first + count;
    vertices.emplace_back(0, 0, *field.bottom);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t next = (k + 1) % count;
      triangles.push_back({border[k], first + k, first + next});
      triangles.push_back({border[k], first + next, border[next]});
      triangles.push_back({middle, first + next, first + k});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace minkray
