// SPDX-License-Identifier: MIT
// Splits objects whose mesh has several parts into one hull per part.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/shape/shape.h"
#include "core/support/named_kind.h"
#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// Values of --split; those of "split" are all but the first.
inline constexpr std::array mesh_splits = {
    NamedKind<MeshSplit>{MeshSplit::none, "none", "no split (default)"},
    NamedKind<MeshSplit>{MeshSplit::groups, "groups", "one hull per named part of the file"},
    NamedKind<MeshSplit>{MeshSplit::components, "components", "one hull per connected part"}};
inline constexpr auto mesh_splits_of_files = std::span(mesh_splits).subspan<1>();

/// One hull a part of the mesh file that the object's shape names. Nothing, and mistakes, if
/// anything is wrong.
std::optional<std::vector<Shape>> read_split_hulls(ObjectReader& object, const Json& split,
                                                   const Json& shape, MeshFiles& meshes);

}  // namespace minkray
