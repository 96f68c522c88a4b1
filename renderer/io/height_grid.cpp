// SPDX-License-Identifier: MIT
#include "renderer/io/height_grid.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "core/files/regular_file.h"
#include "renderer/io/read_image.h"

namespace minkray {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

}  // namespace

HeightGrid read_height_picture(const std::filesystem::path& file) {
  const GreyLevels grey = read_grey(file);
  HeightGrid grid;
  grid.rows = static_cast<std::size_t>(grey.height);
  grid.columns = static_cast<std::size_t>(grey.width);
  grid.heights.reserve(grid.rows * grid.columns);
  for (std::size_t row = grid.rows; row-- > 0;)
    for (std::size_t column = 0; column < grid.columns; ++column)
      grid.heights.push_back(grey.levels[row * grid.columns + column]);
  return grid;
}

HeightGrid read_mujoco_heights(const std::filesystem::path& file) {
  const std::string bytes = read_regular_file(file, most_bytes);
  std::int32_t sizes[2] = {};
  if (bytes.size() < sizeof sizes) throw std::runtime_error("must begin with rows and columns");
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  HeightGrid grid;
  if (sizes[0] < 1 || sizes[1] < 1 || std::size_t(sizes[0]) > most_bytes / std::size_t(sizes[1]))
    throw std::runtime_error("must have rows and columns (got " + std::to_string(sizes[0]) +
                             " and " + std::to_string(sizes[1]) + ")");
  grid.rows = static_cast<std::size_t>(sizes[0]);
  grid.columns = static_cast<std::size_t>(sizes[1]);
  const std::size_t count = grid.rows * grid.columns;
  if (bytes.size() != sizeof sizes + count * sizeof(float))
    throw std::runtime_error("must have a float for each of " + std::to_string(grid.rows) + " x " +
                             std::to_string(grid.columns) + " places (found " +
                             std::to_string(bytes.size() - sizeof sizes) + " bytes)");
  for (std::size_t i = 0; i < count; ++i) {
    float height = 0;
    std::memcpy(&height, bytes.data() + sizeof sizes + i * sizeof height, sizeof height);
    if (!std::isfinite(height)) throw std::runtime_error("must hold finite heights");
    grid.heights.push_back(height);
  }
  return grid;
}

}  // namespace minkray
