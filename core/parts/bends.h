// SPDX-License-Identifier: MIT
// Whether a mesh bends near a point: what is of one plane has one normal there.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// Whether triangles of more than one direction are within `near` of a point in the mesh's frame.
bool bends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near);

}  // namespace minkray
