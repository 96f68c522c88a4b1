// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_height_field.h"

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "core/mesh/height_field.h"
#include "renderer/base/of_file.h"
#include "renderer/io/height_grid.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

constexpr std::size_t most_points = 10'000'000;

/// Least difference of heights, as in MuJoCo.
constexpr double least_difference = 1e-15;

/// From 0 to 1, as far as they differ.
void normalise(std::vector<double>& heights) {
  const auto [least, most] = std::ranges::minmax(heights);
  const double range = most - least;
  for (double& height : heights) {
    height -= least;
    if (range > least_difference) height /= range;
  }
}

/// Rows in the file go from the top down.
HeightGrid written_heights(const XmlElement& asset, XmlFiles& files, std::size_t rows,
                           std::size_t columns) {
  HeightGrid grid{rows, columns, std::vector<double>(rows * columns)};
  if (!asset.attribute("elevation")) return grid;
  const auto numbers = files.numbers(asset, "elevation", rows * columns, rows * columns);
  if (!numbers) throw std::invalid_argument("");  // already reported
  for (std::size_t row = 0; row < rows; ++row)
    std::copy_n(numbers->begin() + static_cast<std::ptrdiff_t>((rows - 1 - row) * columns), columns,
                grid.heights.begin() + static_cast<std::ptrdiff_t>(row * columns));
  return grid;
}

HeightGrid heights_of(
    const XmlElement& asset, XmlFiles& files,
    const std::function<std::optional<std::filesystem::path>(const std::string&)>& find) {
  const std::string name = asset.attribute_or("file");
  if (!name.empty()) {
    const auto file = find(name);
    if (!file) throw std::runtime_error("file: \"" + printable(name, 100) + "\" not found");
    const std::string type = asset.attribute_or("content_type");
    try {
      return file->extension() == ".png" || type == "image/png" ? read_height_picture(*file)
                                                                : read_mujoco_heights(*file);
    } catch (const std::exception& error) {
      throw std::runtime_error(printable(file->string(), 160) + ": " + what_of(error));
    }
  }
  const double rows = files.number(asset, "nrow").value_or(0),
               columns = files.number(asset, "ncol").value_or(0);
  if (!(rows >= 2 && columns >= 2 && rows * columns <= double(most_points)))
    throw std::runtime_error("nrow, ncol: must be at least 2, unless there is a file");
  return written_heights(asset, files, static_cast<std::size_t>(rows),
                         static_cast<std::size_t>(columns));
}

}  // namespace

std::shared_ptr<const TriangleMesh> mjcf_height_field(
    const XmlElement& asset, XmlFiles& files,
    const std::function<std::optional<std::filesystem::path>(const std::string&)>& find) {
  if (!asset.attribute("size")) {
    files.wrong(asset, "size: missing");
    return nullptr;
  }
  const auto size = files.numbers(asset, "size", 4, 4);
  if (!size) return nullptr;
  try {
    if (!std::ranges::all_of(*size, [](double s) { return s > 0; }))
      throw std::runtime_error("size: must be four numbers > 0");
    HeightGrid grid = heights_of(asset, files, find);
    normalise(grid.heights);
    for (double& height : grid.heights) height *= (*size)[2];
    return mesh_of(
        {grid.heights, grid.rows, grid.columns, 2 * (*size)[0], 2 * (*size)[1], -(*size)[3]});
  } catch (const std::exception& error) {
    if (*error.what() != '\0') files.wrong(asset, what_of(error));
    return nullptr;
  }
}

}  // namespace minkray
