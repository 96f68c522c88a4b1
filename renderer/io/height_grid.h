// SPDX-License-Identifier: MIT
// Terrains from files: pictures, where white is the highest, and MuJoCo's binary files.
#pragma once

#include <filesystem>
#include <vector>

namespace minkray {

/// Row by row, the row of the least y first: of a picture the last one.
struct HeightGrid {
  std::size_t rows = 0, columns = 0;
  std::vector<double> heights;
};

/// Throws std::runtime_error for a file that cannot be used.
HeightGrid read_height_picture(const std::filesystem::path& file);

/// MuJoCo's format: two numbers of 32 bits, of rows and columns, and a float for each place.
HeightGrid read_mujoco_heights(const std::filesystem::path& file);

}  // namespace minkray
