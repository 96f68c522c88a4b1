// SPDX-License-Identifier: MIT
// Morph targets: meshes with the weights that the file gives them, or the node that shows them.
#pragma once

#include <compare>
#include <optional>
#include <vector>

#include "renderer/import/mesh/gltf_document.h"

namespace minkray {

/// A mesh with the weights of its morph targets, by which its uses differ.
struct GltfMeshUse {
  std::size_t mesh = 0;
  std::vector<double> weights = {};  ///< without the zeros at its end

  auto operator<=>(const GltfMeshUse&) const = default;
};

/// A mesh with a node's weights, or its own if no node is given or this has none.
GltfMeshUse gltf_mesh_use(GltfDocument& document, std::size_t mesh,
                          std::optional<std::size_t> node = {});

}  // namespace minkray
