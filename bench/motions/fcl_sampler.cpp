// SPDX-License-Identifier: MIT
#include "bench/motions/fcl_sampler.h"

#include <fcl/fcl.h>

#include "core/derived/sandwich.h"
#include "core/geometry/convex_hull.h"
#include "core/mesh/triangle_mesh.h"
#include "renderer/import/model/mesh_hull.h"

namespace minkray {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

template <class Vertices, class Corners>
Geometry mesh_of(const Vertices& vertices, const Corners& triangles) {
  auto mesh = std::make_shared<FclMesh>();
  std::vector<fcl::Vector3d> points;
  for (const Vec3<double>& vertex : vertices)
    points.emplace_back(vertex.x(), vertex.y(), vertex.z());
  std::vector<fcl::Triangle> corners;
  for (const auto& triangle : triangles)
    corners.emplace_back(triangle[0], triangle[1], triangle[2]);
  mesh->beginModel();
  mesh->addSubModel(points, corners);
  mesh->endModel();
  return mesh;
}

/// FCL's primitives where there are any; of hulls the surface.
Geometry geometry_of(const ModelGeom& geom, Triangles triangles) {
  const bool is_hull = triangles == Triangles::of_hulls && geom.touches == Touch::as_hull;
  if (geom.mesh && !is_hull) return mesh_of(geom.mesh->vertices(), geom.mesh->triangles());
  const Shape shape = geom.mesh ? hull_of(*geom.mesh) : *geom.shape;
  const auto& kind = shape.kind;
  if (const auto* box = std::get_if<Box>(&kind))
    return std::make_shared<fcl::Boxd>(2 * box->half_extents.x(), 2 * box->half_extents.y(),
                                       2 * box->half_extents.z());
  if (const auto* ball = std::get_if<Sphere>(&kind))
    return std::make_shared<fcl::Sphered>(ball->radius);
  if (const auto* cylinder = std::get_if<Cylinder>(&kind))
    return std::make_shared<fcl::Cylinderd>(cylinder->radius, 2 * cylinder->half_height);
  if (const auto* hull = std::get_if<Hull>(&kind)) {
    const std::vector<Vec3<double>> points(hull->points.points().begin(),
                                           hull->points.points().end());
    const ConvexHull found = convex_hull(points);
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const std::uint32_t index : found.vertices)
      vertices->emplace_back(points[index].x(), points[index].y(), points[index].z());
    auto faces = std::make_shared<std::vector<int>>();
    for (std::size_t i = 0; i < found.facets.size(); ++i) {
      faces->push_back(static_cast<int>(found.facets[i].size()));
      for (const std::uint32_t corner : found.facets[i]) faces->push_back(static_cast<int>(corner));
    }
    // A solid: what lies within it collides, too.
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(found.facets.size()), faces);
  }
  SandwichOptions options;
  options.margin = 0;
  const Sandwich sandwich = sandwich_of(shape, options);
  std::vector<Vec3<double>> vertices;
  for (const Vec3<double>& vertex : sandwich.inner.vertices)
    vertices.push_back(sandwich.frame.from_frame(vertex));
  return mesh_of(vertices, sandwich.inner.triangles);
}

fcl::Transform3d transform_of(const Affine<double>& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      transform.matrix()(row, column) = pose.linear(row, column);
    transform.matrix()(row, 3) = pose.translation[row];
  }
  return transform;
}

}  // namespace

struct FclSampler::Bodies {
  std::vector<const ModelGeom*> geoms;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;  ///< null: a half-space
};

FclSampler::FclSampler(const Workcell& cell, Triangles triangles)
    : cell_(cell), bodies_(std::make_unique<Bodies>()) {
  const std::vector<bool> chosen = chosen_geoms(cell.model, cell.geometry);
  for (std::size_t i = 0; i < cell.model.geoms.size(); ++i) {
    if (!chosen[i]) continue;
    const ModelGeom& geom = cell.model.geoms[i];
    bodies_->geoms.push_back(&geom);
    bodies_->objects.push_back(
        geom.touches_as_half_space()
            ? nullptr
            : std::make_unique<fcl::CollisionObjectd>(geometry_of(geom, triangles)));
  }
}

FclSampler::~FclSampler() = default;

void FclSampler::place(const JointPath& path, double time) {
  const std::vector<Affine<double>> links = link_poses(path.posed_at(time));
  for (std::size_t i = 0; i < bodies_->geoms.size(); ++i) {
    const ModelGeom& geom = *bodies_->geoms[i];
    if (!bodies_->objects[i]) continue;
    const Affine<double> pose =
        geom.link < 0 ? geom.pose : links[static_cast<std::size_t>(geom.link)] * geom.pose;
    bodies_->objects[i]->setTransform(transform_of(pose));
    bodies_->objects[i]->computeAABB();
  }
}

std::vector<std::size_t> FclSampler::colliding_pairs(const JointPath& path, double time,
                                                     bool first_only) {
  place(path, time);
  std::vector<std::size_t> found;
  for (std::size_t pair = 0; pair < cell_.pairs.size(); ++pair) {
    const auto& a = bodies_->objects[cell_.pairs[pair].a];
    const auto& b = bodies_->objects[cell_.pairs[pair].b];
    if (!a || !b || !a->getAABB().overlap(b->getAABB())) continue;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(a.get(), b.get(), request, result) == 0) continue;
    found.push_back(pair);
    if (first_only) break;
  }
  return found;
}

bool FclSampler::collides(const JointPath& path, double time, std::size_t pair) {
  place(path, time);
  const auto& a = bodies_->objects[cell_.pairs[pair].a];
  const auto& b = bodies_->objects[cell_.pairs[pair].b];
  if (!a || !b) return true;
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(a.get(), b.get(), request, result) > 0;
}

}  // namespace minkray
