// SPDX-License-Identifier: MIT
#include "renderer/import/model/mesh_surface.h"

#include <algorithm>

#include "core/mesh/weld.h"

namespace minkray {

PartTriangles triangles_within(const MeshParts& mesh, const std::vector<std::uint32_t>& part) {
  PartTriangles within;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Corners triangle = mesh.triangles[i];
    bool is_within = true;
    for (std::uint32_t& corner : triangle) {
      const auto at = std::ranges::lower_bound(part, corner);
      is_within &= at != part.end() && *at == corner;
      corner = static_cast<std::uint32_t>(at - part.begin());
    }
    if (!is_within) continue;
    within.corners.push_back(triangle);
    numbers.push_back(i);
  }
  within.attributes = attributes_of(mesh.attributes, numbers);
  return within;
}

namespace {

/// Scale of normals, up to length. A mesh that is flattened along an axis has normals along it.
Vec3<double> scale_of_normals(const Vec3<double>& scale) {
  if ((scale.array() != 0).all()) return scale.cwiseInverse();
  return scale.unaryExpr([](double s) { return s == 0 ? 1.0 : 0.0; });
}

}  // namespace

MeshSurface surface_of(std::vector<Vec3<double>> vertices, PartTriangles triangles,
                       const Vec3<double>& scale) {
  weld(vertices, triangles.corners);
  const auto is_point = [](const Corners& t) { return t[0] == t[1] && t[1] == t[2]; };
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < triangles.corners.size(); ++i)
    if (!is_point(triangles.corners[i])) kept.push_back(i);
  if (kept.empty()) return {};
  MeshAttributes& attributes = triangles.attributes;
  if (kept.size() < triangles.corners.size()) {
    std::erase_if(triangles.corners, is_point);
    attributes = attributes_of(attributes, kept);
  }
  if (scale != Vec3<double>::Constant(scale.x()) || scale.x() < 0)
    map_normals(attributes, scale_of_normals(scale).asDiagonal());
  if (scale.prod() < 0) {
    for (Corners& corners : triangles.corners) std::swap(corners[1], corners[2]);
    swap_corners(attributes);
  }
  settle(attributes);
  MeshSurface surface;
  surface.mesh =
      std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles.corners));
  if (attributes.any())
    surface.attributes = std::make_shared<const MeshAttributes>(std::move(attributes));
  return surface;
}

}  // namespace minkray
