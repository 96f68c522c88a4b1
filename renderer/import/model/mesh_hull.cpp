// SPDX-License-Identifier: MIT
#include "renderer/import/model/mesh_hull.h"

#include <algorithm>
#include <cmath>

#include "renderer/import/model/plane_tree.h"

namespace minkray {
namespace {

/// Largest depth of vertices below the surface of their hull: 0 but for rounding for a convex
/// mesh.
double deepest_below(const std::vector<Vec3<double>>& vertices, const PointCloud& hull) {
  const FacetMesh* facets = hull.facets();
  if (!facets) return 0;
  Vec3<double> lower = hull.points()[0], upper = lower;
  for (const Vec3<double>& vertex : hull.points()) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  const Vec3<double> half = (upper - lower) / 2, centre = lower + half;
  std::vector<PlaneTree::Plane> planes;
  for (std::size_t i = 0; i < facets->size(); ++i) {
    const Vec3<double> n = (*facets)[i].normal();
    if (!n.isZero(0))
      planes.push_back({n.x(), n.y(), n.z(), n.dot((*facets)[i].corner(0) - centre)});
  }
  const PlaneTree tree(std::move(planes), half.maxCoeff());
  double deepest = 0;
  // The hull has its own points in the vertices' order; they lie below nothing.
  auto own = hull.points().begin();
  for (const Vec3<double>& vertex : vertices) {
    if (own != hull.points().end() && vertex == *own) {
      ++own;
      continue;
    }
    const double depth = tree.least_depth(vertex - centre, deepest);
    if (std::isfinite(depth)) deepest = std::max(deepest, depth);
  }
  return deepest;
}

std::vector<Vec3<double>> vertices_of(const TriangleMesh& mesh) {
  return {mesh.vertices().begin(), mesh.vertices().end()};
}

}  // namespace

Shape hull_of(const TriangleMesh& mesh) {
  return Hull{PointCloud(vertices_of(mesh))};
}

std::vector<Vec3<double>> hull_points_of(const TriangleMesh& mesh) {
  const PointCloud hull(vertices_of(mesh));
  return {hull.points().begin(), hull.points().end()};
}

MeshFacts facts_of(const ModelMesh& mesh) {
  MeshFacts facts;
  const auto add_hull = [&](const std::vector<Vec3<double>>& vertices, const PointCloud& hull) {
    facts.hull_points += hull.points().size();
    facts.deepest = std::max(facts.deepest, deepest_below(vertices, hull));
  };
  for (const ModelMesh::Part& part : mesh.parts) {
    if (!part.surface) {
      add_hull(part.vertices, *part.hull);
      continue;
    }
    const MeshFaults faults = part.surface->faults();
    facts.triangles += part.surface->size();
    facts.without_area += faults.without_area;
    facts.repeated += faults.repeated;
    facts.open_edges += faults.open_edges;
    const std::vector<Vec3<double>> vertices = vertices_of(*part.surface);
    add_hull(vertices, PointCloud(vertices));
  }
  return facts;
}

}  // namespace minkray
