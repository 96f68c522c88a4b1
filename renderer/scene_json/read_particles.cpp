// SPDX-License-Identifier: MIT
#include "renderer/scene_json/read_particles.h"

#include <algorithm>
#include <exception>
#include <limits>

#include "core/support/named_kind.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/particle_rows.h"
#include "renderer/scene_json/read_visible_to.h"

namespace minkray {
namespace {

constexpr std::size_t most_materials = std::numeric_limits<std::uint16_t>::max();

bool contains(const std::vector<ParticleColumn>& columns, ParticleColumn column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

/// The columns' names; the position alone if there are none.
std::optional<std::vector<ParticleColumn>> read_columns(ObjectReader& block) {
  const Json* json = block.find("columns");
  if (!json) return std::vector{ParticleColumn::position};
  const JsonPath path = block.path("columns");
  Mistakes& mistakes = block.mistakes();
  if (!json->is_array()) {
    mistakes.add(path, "must be a list of names of columns (" + found(*json) + ")");
    return std::nullopt;
  }
  std::vector<ParticleColumn> columns;
  for (std::size_t i = 0; i < json->size(); ++i) {
    const auto name = read_string((*json)[i], path / i, mistakes);
    if (!name) return std::nullopt;
    const ParticleColumnDescription* known = row_named(particle_columns, *name);
    if (!known) {
      mistakes.add(path / i, "must be the name of a column (" + found((*json)[i]) + "; " +
                                 suggestion(*name, names_in(particle_columns)) + ")");
      return std::nullopt;
    }
    if (contains(columns, known->column)) {
      mistakes.add(path / i, "duplicate (" + found((*json)[i]) + " again)");
      return std::nullopt;
    }
    columns.push_back(known->column);
  }
  if (!contains(columns, ParticleColumn::position)) {
    mistakes.add(path, "must contain \"position\" (" + found(*json) + " without it)");
    return std::nullopt;
  }
  if (contains(columns, ParticleColumn::scale) && contains(columns, ParticleColumn::scales)) {
    mistakes.add(path, "must have one of \"scale\" and \"scales\" (got both)");
    return std::nullopt;
  }
  return columns;
}

/// Either "material", or "materials" for a column of indices.
bool read_materials(ObjectReader& block, bool has_column, const ParticleSource& source,
                    std::vector<std::uint32_t>& materials) {
  if (!has_column) {
    const Json* name = block.require("material", "the name of a material");
    if (name) materials = {source.material_named(*name, block.path("material"))};
    return name;
  }
  const Json* names = block.require("materials", "a list of the names of materials");
  if (!names) return false;
  const JsonPath path = block.path("materials");
  if (!names->is_array() || names->empty() || names->size() > most_materials) {
    block.mistakes().add(path, "must be a list of the names of 1 to " +
                                   std::to_string(most_materials) + " materials (" + found(*names) +
                                   ")");
    return false;
  }
  for (std::size_t i = 0; i < names->size(); ++i)
    materials.push_back(source.material_named((*names)[i], path / i));
  return true;
}

/// Poses in the scene file itself: a list of rows.
bool read_inline(const Json& json, const JsonPath& path, Mistakes& mistakes,
                 std::optional<std::size_t> count, std::size_t most_rows, ParticleRows& rows) {
  if (!json.is_array() || json.empty() || json.size() > most_rows ||
      (count && json.size() != *count)) {
    const std::string number =
        count ? std::to_string(*count) + " rows, as \"count\" says"
              : "at least one row and at most " + std::to_string(most_rows) + " rows";
    mistakes.add(path, "must be a list of " + number + " (" + found(json) + ")");
    return false;
  }
  rows.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto row = read_numbers(json[i], path / i, mistakes, rows.row_numbers());
    if (!row) return false;
    if (const auto wrong = rows.add(*row)) {
      mistakes.add(path / i, *wrong);
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<ParticleSet> read_particles(const Json& json, const JsonPath& path,
                                          Mistakes& mistakes, const ParticleSource& source) {
  ObjectReader block(json, path, mistakes);
  if (!block.is_object()) return std::nullopt;
  block.allow({"name", "shape", "columns", "material", "materials", "count", "poses", "file",
               "visible_to"});
  ParticleSet set;
  bool good = true;
  if (const Json* written = block.require("name", "the particles' name")) {
    set.name = read_string(*written, block.path("name"), mistakes).value_or("");
    if (set.name.empty()) mistakes.add(block.path("name"), "must not be empty");
  }
  if (const Json* written = block.require("shape", "a shape")) {
    auto shape = read_shape(*written, block.path("shape"), mistakes, source.meshes);
    good &= shape.has_value();
    if (shape) set.shape = std::move(*shape);
  }
  const auto columns = read_columns(block);
  good &= columns && read_materials(block, contains(*columns, ParticleColumn::material), source,
                                    set.materials);
  set.visible_to = read_visible_to(block);
  for (const std::uint32_t material : set.materials)
    check_visible(source.scene, material, set.visible_to, block);
  std::optional<std::size_t> count;
  if (const Json* written = block.find("count")) {
    const auto number =
        read_integer(*written, block.path("count"), mistakes, 1, std::numeric_limits<int>::max());
    good &= number.has_value();
    if (number) count = static_cast<std::size_t>(*number);
  }
  const Json* poses = block.find("poses");
  const Json* file = block.find("file");
  if (!poses == !file) {
    mistakes.add(path, std::string("must have either \"poses\" or \"file\" (got ") +
                           (poses ? "both)" : "neither)"));
    good = false;
  }
  const char* unused =
      columns && contains(*columns, ParticleColumn::material) ? "material" : "materials";
  if (columns && block.find(unused)) {
    mistakes.add(block.path(unused), std::string("not allowed: use \"materials\" with a column ") +
                                         "\"material\", else \"material\"");
    good = false;
  }
  block.finish();
  if (!good) return std::nullopt;

  // Last, and only if all else is right: files may be large.
  ParticleRows rows(*columns, set);
  if (poses) {
    if (!read_inline(*poses, block.path("poses"), mistakes, count, source.most_rows, rows))
      return std::nullopt;
    rows.finish();
    return set;
  }
  const auto name = read_string(*file, block.path("file"), mistakes);
  if (!name) return std::nullopt;
  const std::string from_scene = source.meshes.from_scene(*name);
  const std::filesystem::path named = source.folder / from_scene;
  try {
    source.hash.add(from_scene);
    source.files.push_back(named);
    read_particle_file(named, count, source.most_rows, rows, source.hash);
  } catch (const std::runtime_error& error) {
    mistakes.add(block.path("file"), printable(named.string(), 200) + ": " + error.what());
    return std::nullopt;
  }
  return set;
}

}  // namespace minkray
