// SPDX-License-Identifier: MIT
#include "core/mesh/mapped.h"

namespace minkray {

std::shared_ptr<const TriangleMesh> mapped(const TriangleMesh& mesh, const Affine<double>& map) {
  std::vector<Vec3<double>> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3<double>& vertex : vertices) vertex = map(vertex);
  std::vector<Corners> triangles(mesh.triangles().begin(), mesh.triangles().end());
  if (map.linear.determinant() < 0)
    for (Corners& corners : triangles) std::swap(corners[1], corners[2]);
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles),
                                              mesh.sides());
}

}  // namespace minkray
