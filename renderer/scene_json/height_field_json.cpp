// SPDX-License-Identifier: MIT
#include "renderer/scene_json/height_field_json.h"

#include <stdexcept>

#include "core/mesh/height_field.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

std::optional<HeightGrid> read_rows(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (!json.is_array() || json.size() < 2 || !json[0].is_array() || json[0].size() < 2) {
    mistakes.add(
        path, "must be a list of rows, at least two of at least two heights (" + found(json) + ")");
    return std::nullopt;
  }
  HeightGrid grid{json.size(), json[0].size(), {}};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const auto heights = read_numbers(json[row], path / row, mistakes, grid.columns);
    if (!heights) return std::nullopt;
    grid.heights.insert(grid.heights.end(), heights->begin(), heights->end());
  }
  return grid;
}

}  // namespace

std::shared_ptr<const TriangleMesh> read_height_field(const Json& json, const JsonPath& path,
                                                      Mistakes& mistakes, MeshFiles& files) {
  ObjectReader object(json, path, mistakes);
  if (!object.is_object()) return nullptr;
  const Json* const file = object.find("file");
  const Json* const rows =
      file ? nullptr : object.require("heights", "a list of rows of heights, or \"file\"");
  const Json* const sizes = object.require(
      "size", file ? "three sizes: along x, along y, and the height of white" : "two sizes");
  const Json* const written_bottom = object.find("bottom");
  std::optional<HeightGrid> grid;
  std::optional<std::vector<double>> size;
  if (sizes)
    size = read_numbers(*sizes, object.path("size"), mistakes, file ? 3 : 2, Range::positive);
  if (rows) grid = read_rows(*rows, object.path("heights"), mistakes);
  std::shared_ptr<const TriangleMesh> of_rows;
  std::shared_ptr<const TriangleMesh>* mesh = &of_rows;
  if (file)
    if (const auto name = read_string(*file, object.path("file"), mistakes)) {
      mesh = &files.terrain(*name, json.dump());
      if (*mesh) return *mesh;
      grid = files.read_heights(*name, object.path("file"), mistakes);
    }
  std::optional<double> bottom;
  bool is_good = true;
  if (written_bottom) {
    bottom = read_number(*written_bottom, object.path("bottom"), mistakes);
    is_good = bottom.has_value();
  }
  if (!object.finish() || !is_good || !grid || !size) return nullptr;
  if (file)
    for (double& height : grid->heights) height *= (*size)[2];
  try {
    return *mesh =
               mesh_of({grid->heights, grid->rows, grid->columns, (*size)[0], (*size)[1], bottom});
  } catch (const std::invalid_argument& error) {
    mistakes.add(path, error.what());
    return nullptr;
  }
}

}  // namespace minkray
