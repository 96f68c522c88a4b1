// SPDX-License-Identifier: MIT
// Meshes in scene files, in the place of an object's shape: "mesh": {"file": "jaw.stl", "scale":
// 0.001}, or with "vertices" and "triangles" in the place of a file.
#pragma once

#include <memory>

#include "core/mesh/triangle_mesh.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// No mesh, and mistakes, if anything in it is wrong. The result refers to the JSON.
SceneMesh read_mesh(const Json& json, const JsonPath& path, Mistakes& mistakes, MeshFiles& files);

/// Writes vertices and triangles, and the look if there is one.
Json write_mesh(const TriangleMesh& mesh, const MeshLook* look, const Scene& scene);

}  // namespace minkray
