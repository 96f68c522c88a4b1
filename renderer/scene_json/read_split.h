// SPDX-License-Identifier: MIT
// Splits objects whose mesh has several parts into one hull per part.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/shape/shape.h"
#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// Values of "split" and their meaning.
struct MeshSplitName {
  std::string_view name;
  MeshSplit split;
};
inline constexpr std::array mesh_split_names = {MeshSplitName{"groups", MeshSplit::groups},
                                                MeshSplitName{"components", MeshSplit::components}};

/// One hull a part of the mesh file that the object's shape names. Nothing, and mistakes, if
/// anything is wrong.
std::optional<std::vector<Shape>> read_split_hulls(ObjectReader& object, const Json& split,
                                                   const Json& shape, MeshFiles& meshes);

}  // namespace minkray
