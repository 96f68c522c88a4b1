// SPDX-License-Identifier: MIT
#include "core/polytope/polytope.h"

#include "core/polytope/polytope_maker.h"

namespace minkray::exact {
namespace {

/// Limit of points. Each plane is tested against each point, which would take over a second for
/// more.
constexpr std::size_t most_points = 4096;

}  // namespace

Polytope::Polytope(const std::vector<Vec3<double>>& vertices, double rounded_by) {
  Vec3<double> extents = Vec3<double>::Zero();
  for (const Vec3<double>& vertex : vertices) {
    radius_ = std::max(radius_, vertex.norm());
    extents = extents.cwiseMax(vertex.cwiseAbs());
  }
  radius_ *= 1 + 4 * std::numeric_limits<double>::epsilon();
  rounding_ = tolerance::polytope_rounding * radius_;
  extents = extents.cwiseMax(Vec3<double>::Constant(extents.maxCoeff() / 65536));
  tables_.by_extents = (extents + Vec3<double>::Constant(rounded_by)).cwiseInverse();
  tables_.rounded_by = rounded_by;
}

std::shared_ptr<const Polytope> Polytope::of(const PointCloud& points, const Vec3<double>& middle,
                                             double down, double rounded_by) {
  const FacetMesh* mesh = points.facets();
  if (!mesh || points.points().size() > most_points) return nullptr;
  std::vector<Vec3<double>> vertices;
  for (const Vec3<double>& point : points.points()) vertices.push_back(point * down - middle);
  const std::shared_ptr<Polytope> made(new Polytope(vertices, rounded_by));
  if (!std::isfinite(made->radius_ + rounded_by)) return nullptr;
  Maker maker(*made, std::move(vertices));
  if (!maker.take_triangles(*mesh, points.points())) return nullptr;
  maker.find_planes();
  if (!maker.find_inside()) return nullptr;
  if (rounded_by > 0 && !maker.make_room_for_rounding()) return nullptr;
  maker.fill_tables();
  maker.fill_map([&](const Vec3<double>& direction) { return mesh->facing<double>(direction); });
  return made;
}

std::shared_ptr<const Polytope> Polytope::of(const std::array<Vec3<double>, 3>& corners,
                                             double rounded_by) {
  std::vector<Vec3<double>> vertices(corners.begin(), corners.end());
  const std::shared_ptr<Polytope> made(new Polytope(vertices, rounded_by));
  if (!(rounded_by > 0) || !std::isfinite(made->radius_ + rounded_by)) return nullptr;
  Maker maker(*made, std::move(vertices));
  maker.take_two_sides();
  if (!maker.make_room_for_rounding()) return nullptr;
  maker.fill_tables();
  const Vec3<double> normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  maker.fill_map(
      [&](const Vec3<double>& direction) { return direction.dot(normal) > 0 ? 0u : 1u; });
  return made;
}

}  // namespace minkray::exact
