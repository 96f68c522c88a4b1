// SPDX-License-Identifier: MIT
#include "bullet.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

namespace bench {
namespace {

btScalar scalar(double x) {
  return static_cast<btScalar>(x);
}

template <class Make>
BulletBody both(Body ours, const Make& make) {
  BulletBody body{std::move(ours), make(), make()};
  body.without_margin->setMargin(0);
  return body;
}

}  // namespace

// A sphere's and a capsule's margin is their radius.
BulletBody bullet_sphere(double radius) {
  return {sphere(radius), std::make_shared<btSphereShape>(scalar(radius)), nullptr};
}
BulletBody bullet_capsule(double radius, double half_height) {
  return {capsule(radius, half_height),
          std::make_shared<btCapsuleShapeZ>(scalar(radius), scalar(2 * half_height)), nullptr};
}

BulletBody bullet_box(const Vec& half_extents) {
  return both(box(half_extents),
              [&] { return std::make_shared<btBoxShape>(to_bullet(half_extents)); });
}
BulletBody bullet_cylinder(double radius, double half_height) {
  return both(cylinder(radius, half_height), [&] {
    return std::make_shared<btCylinderShapeZ>(
        btVector3(scalar(radius), scalar(radius), scalar(half_height)));
  });
}
BulletBody bullet_cone(double radius, double half_height) {
  return both(cone(radius, half_height), [&] {
    return std::make_shared<btConeShapeZ>(scalar(radius), scalar(2 * half_height));
  });
}
BulletBody bullet_hull(const std::vector<Vec>& points) {
  return both(hull(points), [&] {
    auto made = std::make_shared<btConvexHullShape>();
    for (const Vec& p : points) made->addPoint(to_bullet(p), &p == &points.back());
    return made;
  });
}

btVector3 to_bullet(const Vec& v) {
  return {scalar(v.x), scalar(v.y), scalar(v.z)};
}

btTransform to_bullet(const mk::Pose& pose) {
  const auto at = [&](int i, int j) { return scalar(pose.rows[i][j]); };
  return btTransform(btMatrix3x3(at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2),
                                 at(2, 0), at(2, 1), at(2, 2)),
                     btVector3(at(0, 3), at(1, 3), at(2, 3)));
}

}  // namespace bench
