// SPDX-License-Identifier: MIT
// Tests whether a mesh bends near a point: triangles there have different normals.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// True if triangles with different normals are within `near` of a point in the mesh's frame.
bool bends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near);

}  // namespace minkray
