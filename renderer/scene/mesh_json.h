// SPDX-License-Identifier: MIT
// Meshes in scene files, in the place of an object's shape: "mesh": {"file": "jaw.stl", "scale":
// 0.001}, or with "vertices" and "triangles" in the place of a file.
#pragma once

#include <memory>

#include "core/mesh/triangle_mesh.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/mesh_files.h"

namespace minkray {

/// Null, and mistakes, if anything in it is wrong.
std::shared_ptr<const TriangleMesh> read_mesh(const Json& json, const JsonPath& path,
                                              Mistakes& mistakes, MeshFiles& files);

/// By its vertices and triangles.
Json write_mesh(const TriangleMesh& mesh);

}  // namespace minkray
