// SPDX-License-Identifier: MIT
#include "renderer/import/model/mesh_hull.h"

#include <algorithm>
#include <cmath>

#include "core/parts/parts_distance.h"
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

/// Calls visit(point) for a grid of points on the facet, its middle among them.
template <class Visit>
void for_each_point(const FacetMesh::Facet& facet, double spacing, const Visit& visit) {
  const Vec3<double> a = facet.corner(0), b = facet.corner(1) - a, c = facet.corner(2) - a;
  visit(Vec3<double>(a + (b + c) / 3));
  const double rows = std::ceil(b.norm() / spacing), columns = std::ceil(c.norm() / spacing);
  for (double i = 0.5; i < rows; ++i)
    for (double k = 0.5; k < columns && i / rows + k / columns <= 1; ++k)
      visit(Vec3<double>(a + i / rows * b + k / columns * c));
}

double overshoot_of(const FacetMesh& hull, const TriangleMesh& mesh) {
  constexpr double steps = 12;
  const double spacing = (mesh.bounds().upper - mesh.bounds().lower).maxCoeff() / steps;
  const ContactShape point{Shape(Point())};
  double most = 0;
  Affine<double> pose;
  for (std::size_t i = 0; i < hull.size(); ++i)
    for_each_point(hull[i], spacing, [&](const Vec3<double>& at) {
      pose.translation = at;
      most = std::max(most, signed_distance(mesh, {}, point, pose).value);
    });
  return most;
}

/// Volume that a closed surface of triangles encloses, relative to a point near it.
template <class Corner>
double volume_of(std::size_t triangles, const Vec3<double>& middle, const Corner& corner) {
  double volume = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3<double> a = corner(i, 0) - middle, b = corner(i, 1) - middle,
                       c = corner(i, 2) - middle;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

double missing_volume_of(const FacetMesh& hull, const TriangleMesh& mesh) {
  const Vec3<double> middle = mesh.bounds().centre();
  const double whole = volume_of(hull.size(), middle,
                                 [&](std::size_t i, std::size_t k) { return hull[i].corner(k); });
  const double own = volume_of(mesh.size(), middle, [&](std::size_t i, std::size_t k) {
    return mesh.corner(static_cast<std::uint32_t>(i), k);
  });
  return whole > 0 ? std::abs(whole - std::abs(own)) / whole : 0;
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
    const PointCloud hull(vertices);
    add_hull(vertices, hull);
    const FacetMesh* const facets = hull.facets();
    if (!facets) {
      facts.is_flat = true;
      continue;
    }
    facts.overshoot = std::max(facts.overshoot, overshoot_of(*facets, *part.surface));
    if (faults.is_closed())
      facts.missing_volume =
          std::max(facts.missing_volume, missing_volume_of(*facets, *part.surface));
  }
  return facts;
}

}  // namespace minkray
