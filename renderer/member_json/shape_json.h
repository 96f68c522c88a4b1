// SPDX-License-Identifier: MIT
// Shapes from JSON and to JSON, by their described fields. No kind of shape is named here.
#pragma once

#include <optional>

#include "core/shape/shape.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// Reads one shape, nested to any depth. Returns nothing and adds mistakes if any part is invalid.
/// `path` is its location in the file.
std::optional<Shape> read_shape(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                MeshFiles& meshes);

/// Reads a list of shapes with a least length.
std::optional<ShapeList> read_shapes(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                     MeshFiles& meshes, std::size_t least);

/// Inverse of read_shape. Points from a mesh file are written as that file's name.
Json write_shape(const Shape& shape);

}  // namespace minkray
