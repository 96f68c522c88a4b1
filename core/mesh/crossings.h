// SPDX-License-Identifier: MIT
// All points where a ray passes through a mesh, in their order: a closed mesh without
// self-intersections is entered and left in turn.
#pragma once

#include <vector>

#include "core/mesh/mesh_ray.h"

namespace minkray {

/// Returns the triangles that the ray passes with 0 <= t <= t_max, in exact order; t never
/// decreases, and `error` remains a bound. A ray through an edge or a vertex passes one of the
/// triangles there; it may enter and leave there, or not at all if it only touches the mesh.
/// Triangles in one plane follow in the order that leaves and enters in turn.
std::vector<PartHit> crossings(const TriangleMesh& mesh, const Ray<double>& ray);

}  // namespace minkray
