// SPDX-License-Identifier: MIT
// Triangles of a mesh for the page, around the one that a ray hits. A mesh of too many triangles is
// made coarser: vertices of one cell of a grid become one (Rossignac and Borrel, 1993).
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "renderer/json/json.h"

namespace minkray {

/// Most triangles on a page: of all meshes, and of one.
inline constexpr std::size_t body_triangles_of_page = 60'000, body_triangles_of_mesh = 4000;

/// {"v": [x, y, z, ...], "t": [corners, ...], "scale", "middle", "coarse"}: coordinates from the
/// middle, as whole numbers to be multiplied by the scale.
Json body_json(const TriangleMesh& mesh, std::size_t most_triangles);

/// One triangle, as mesh_json() writes a flat shape.
Json triangle_json(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3<double>& middle,
                   double radius);

}  // namespace minkray
