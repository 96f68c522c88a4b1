// SPDX-License-Identifier: MIT
// Attributes of meshes in scene files: "smooth", "normals", "uv" and "material_of" next to a mesh's
// vertices and triangles.
#pragma once

#include <optional>

#include "core/files/mesh_attributes.h"
#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// Reads "smooth": true, false or the largest smooth angle in degrees.
std::optional<MeshShading> read_shading(ObjectReader& mesh);

/// Reads the attributes of a mesh whose vertices and triangles are given; nothing, and mistakes, if
/// any is wrong.
std::optional<MeshAttributes> read_attributes(ObjectReader& mesh,
                                              std::span<const Vec3<double>> vertices,
                                              std::span<const MeshAttributes::Numbers> triangles,
                                              const MeshShading& shading);

/// Adds the keys that read_attributes() reads.
void write_attributes(Json& mesh, const MeshAttributes& attributes);

}  // namespace minkray
