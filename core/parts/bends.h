// SPDX-License-Identifier: MIT
// Tests whether a mesh bends or ends near a point: triangles there have different normals, or one
// of their edges has no other triangle.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// True if triangles with different normals, or an open edge, are within `near` of a point in the
/// mesh's frame. An edge of two triangles must have the same ends in both.
bool bends_or_ends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near);

}  // namespace minkray
