// SPDX-License-Identifier: MIT
// Shapes from JSON and to JSON, by their described fields. No kind of shape is named here.
#pragma once

#include <optional>

#include "core/shape/shape.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// One shape, nested as deeply as it may be. Nothing, and mistakes, if anything in it is wrong.
/// `path` is where the JSON stands in its file.
std::optional<Shape<double>> read_shape(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                        MeshFiles& meshes);

/// A list of shapes: at least so many.
std::optional<ShapeList<double>> read_shapes(const Json& json, const JsonPath& path,
                                             Mistakes& mistakes, MeshFiles& meshes,
                                             std::size_t least);

/// What read_shape makes the same shape of. Points that came from a mesh file are written as that
/// file's name.
Json write_shape(const Shape<double>& shape);

}  // namespace minkray
