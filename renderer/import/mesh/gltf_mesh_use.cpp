// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_mesh_use.h"

#include <algorithm>

#include "renderer/json/values.h"

namespace minkray {
namespace {

std::vector<double> weights_of(GltfDocument& document, const Json& object, const JsonPath& path) {
  const Json* given = object.find("weights");
  if (!given || !given->is_array()) return {};
  return read_numbers(*given, path / "weights", document.mistakes(), given->size())
      .value_or(std::vector<double>());
}

/// The largest number of morph targets of a mesh's primitives.
std::size_t target_count(const Json& mesh) {
  std::size_t most = 0;
  const Json* primitives = mesh.find("primitives");
  for (std::size_t i = 0; primitives && primitives->is_array() && i < primitives->size(); ++i) {
    const Json& primitive = (*primitives)[i];
    const Json* targets = primitive.is_object() ? primitive.find("targets") : nullptr;
    if (targets && targets->is_array()) most = std::max(most, targets->size());
  }
  return most;
}

}  // namespace

GltfMeshUse gltf_mesh_use(GltfDocument& document, std::size_t mesh,
                          std::optional<std::size_t> node) {
  const Json& json = document.item("meshes", mesh);
  GltfMeshUse use{mesh};
  const std::size_t most = target_count(json);
  if (most == 0) return use;
  const bool is_own = node && document.item("nodes", *node).find("weights");
  use.weights =
      is_own ? weights_of(document, document.item("nodes", *node), JsonPath() / "nodes" / *node)
             : weights_of(document, json, JsonPath() / "meshes" / mesh);
  use.weights.resize(std::min(use.weights.size(), most));
  while (!use.weights.empty() && use.weights.back() == 0) use.weights.pop_back();
  return use;
}

}  // namespace minkray
