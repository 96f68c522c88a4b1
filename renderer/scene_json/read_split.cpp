// SPDX-License-Identifier: MIT
#include "renderer/scene_json/read_split.h"

#include "renderer/json/values.h"

namespace minkray {

std::optional<std::vector<Shape>> read_split_hulls(ObjectReader& object, const Json& split,
                                                   const Json& shape, MeshFiles& meshes) {
  Mistakes& mistakes = object.mistakes();
  const JsonPath split_path = object.path("split"), shape_path = object.path("shape");
  const auto written = read_string(split, split_path, mistakes);
  if (!written) return std::nullopt;
  const NamedKind<MeshSplit>* const how = row_named(mesh_splits_of_files, *written);
  if (!how) {
    mistakes.add(split_path, "must be groups or components (" + found(split) + "; " +
                                 suggestion(*written, names_in(mesh_splits_of_files)) + ")");
    return std::nullopt;
  }
  const Json* type = shape.is_object() ? shape.find("type") : nullptr;
  const Json* file = shape.is_object() ? shape.find("file") : nullptr;
  if (!type || !type->is_string() || type->text() != Hull::name || !file || shape.size() != 2) {
    mistakes.add(split_path, "needs a shape {\"type\": \"hull\", \"file\": ...}");
    return std::nullopt;
  }
  const auto name = read_string(*file, shape_path / "file", mistakes);
  const auto parts =
      name ? meshes.read_parts(*name, how->kind, shape_path / "file", mistakes) : std::nullopt;
  if (!parts) return std::nullopt;
  std::vector<Shape> hulls;
  for (const PointCloud& part : *parts) hulls.emplace_back(Hull{part});
  return hulls;
}

}  // namespace minkray
