// SPDX-License-Identifier: MIT
#include "nine_bodies.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include "hull_facets.h"

namespace bench {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> fcl_hull(const std::vector<Vec>& points) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec& p : points) vertices->emplace_back(p.x, p.y, p.z);
  auto faces = std::make_shared<std::vector<int>>();
  const auto facets = hull_facets(points);
  for (const auto& facet : facets) {
    faces->push_back(3);
    for (const std::uint32_t corner : facet) faces->push_back(static_cast<int>(corner));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(facets.size()), faces);
}

NinthBody body_of(const char* name, const BulletBody& both,
                  std::shared_ptr<fcl::CollisionGeometryd> of_fcl, bool fcl_casts) {
  return {name,
          both.ours.shape,
          both.ours.radius,
          both.without_margin,
          both.without_margin,
          std::move(of_fcl),
          fcl_casts};
}

/// Bullet rounds boxes off by their margin, which it takes from the half extents; its casts do so
/// with a hull.
NinthBody rounded_body(const Vec& half, double radius) {
  const auto grown = [&](double x) { return static_cast<btScalar>(x + radius); };
  const auto margin =
      std::make_shared<btBoxShape>(btVector3(grown(half.x), grown(half.y), grown(half.z)));
  margin->setMargin(static_cast<btScalar>(radius));
  const auto corners = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 8; ++i)
    corners->addPoint(
        to_bullet(Vec{(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                      (i & 4) != 0 ? half.z : -half.z}),
        i == 7);
  corners->setMargin(static_cast<btScalar>(radius));
  const Body ours = rounded_box(half, radius);
  return {"rounded box", ours.shape, ours.radius, margin, corners, nullptr};
}

}  // namespace

std::vector<NinthBody> nine_bodies() {
  const std::vector<Vec> some = random_points(32, {1, 1, 1}, 7),
                         many = random_points(64, {1, 1, 1}, 7);
  const Body egg = ellipsoid({1, 0.6, 0.3});
  return {body_of("sphere", bullet_sphere(0.5), std::make_shared<fcl::Sphered>(0.5), true),
          body_of("capsule", bullet_capsule(0.25, 0.75), std::make_shared<fcl::Capsuled>(0.25, 1.5),
                  true),
          body_of("box", bullet_box({1, 0.5, 0.25}), std::make_shared<fcl::Boxd>(2, 1, 0.5), true),
          body_of("cylinder", bullet_cylinder(0.5, 0.75),
                  std::make_shared<fcl::Cylinderd>(0.5, 1.5), true),
          body_of("cone", bullet_cone(0.5, 0.75), std::make_shared<fcl::Coned>(0.5, 1.5), true),
          {"ellipsoid", egg.shape, egg.radius, nullptr, nullptr,
           std::make_shared<fcl::Ellipsoidd>(1, 0.6, 0.3)},
          body_of("hull 32", bullet_hull(some), fcl_hull(some), false),
          body_of("hull 64", bullet_hull(many), fcl_hull(many), false),
          rounded_body({0.8, 0.4, 0.2}, 0.1)};
}

fcl::Transform3d to_fcl(const mk::Pose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rows[i][j];
    result.translation()[i] = pose.rows[i][3];
  }
  return result;
}

}  // namespace bench
