// SPDX-License-Identifier: MIT
// Surfaces of mesh files' parts: their triangles, welded, with attributes.
#pragma once

#include <memory>
#include <vector>

#include "core/files/mesh_parts.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

struct PartTriangles {
  std::vector<Corners> corners;
  MeshAttributes attributes = {};
};

/// The triangles whose corners are all in the part, whose vertices are sorted, by their numbers
/// there.
PartTriangles triangles_within(const MeshParts& mesh, const std::vector<std::uint32_t>& part);

struct MeshSurface {
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< null if nothing has an area
  std::shared_ptr<const MeshAttributes> attributes = {};
};

/// The vertices must be scaled already; `scale` maps normals and turns mirrored triangles over.
MeshSurface surface_of(std::vector<Vec3<double>> vertices, PartTriangles triangles,
                       const Vec3<double>& scale);

}  // namespace minkray
