// SPDX-License-Identifier: MIT
// Terrains in scene files, in the place of an object's shape: "height_field": {"file": "hills.png",
// "size": [8, 8, 1.5]}, or with "heights" in the place of a file.
#pragma once

#include <memory>

#include "core/mesh/triangle_mesh.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {

/// Null, and mistakes, if anything in it is wrong.
std::shared_ptr<const TriangleMesh> read_height_field(const Json& json, const JsonPath& path,
                                                      Mistakes& mistakes, MeshFiles& files);

}  // namespace minkray
