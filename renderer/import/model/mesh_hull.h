// SPDX-License-Identifier: MIT
// Convex hull of a mesh, computed only on request: Qhull takes longer than reading the file.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/shape/shape.h"
#include "renderer/import/model/model.h"

namespace minkray {

/// The hull of the triangles' vertices, as a shape and as its points.
Shape hull_of(const TriangleMesh& mesh);
std::vector<Vec3<double>> hull_points_of(const TriangleMesh& mesh);

/// Facts about a mesh file for `minkray info`.
struct MeshFacts {
  std::size_t triangles = 0, without_area = 0, repeated = 0, open_edges = 0;
  std::size_t hull_points = 0;
  double deepest = 0;  ///< largest depth of a vertex below the hull's surface
  /// Largest distance of a point of the hull's surface from the mesh: of a grid of points on each
  /// facet.
  double overshoot = 0;
  /// Largest difference of the volumes of closed parts and their hulls, relative to the hull's.
  double missing_volume = 0;
  bool is_flat = false;  ///< a part has no volume
  bool is_closed() const { return triangles > without_area && open_edges == 0; }
};
MeshFacts facts_of(const ModelMesh& mesh);

}  // namespace minkray
