// SPDX-License-Identifier: MIT
// Wavefront OBJ: vertices, faces and groups; on request also normals, texture coordinates and names
// of materials.
#pragma once

#include <string_view>
#include <vector>

#include "core/files/triangle_fans.h"
#include "core/math/vec.h"

namespace minkray {

/// Returns all vertices, in the file's order. Adds faces to `fans`.
std::vector<Vec3<double>> vertices_of_obj(std::string_view text, TriangleFans fans);

}  // namespace minkray
