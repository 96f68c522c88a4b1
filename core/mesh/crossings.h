// SPDX-License-Identifier: MIT
// All points where a ray passes through a mesh, in order along the ray. In a closed mesh without
// self-intersections, entries and exits alternate.
#pragma once

#include <vector>

#include "core/mesh/mesh_ray.h"

namespace minkray {

/// Returns the triangles that the ray passes through with 0 <= t <= t_max, in exact order. From one
/// to the next, t never decreases, and `error` remains a bound. A ray that crosses the surface at
/// an edge or a vertex passes one of the triangles there. A ray that only touches the mesh there
/// passes either an entry and an exit, or no triangle. Triangles in one plane are sorted so that
/// entries and exits alternate.
std::vector<PartHit> crossings(const TriangleMesh& mesh, const Ray<double>& ray);

}  // namespace minkray
