// SPDX-License-Identifier: MIT
// Shapes as Bullet's and as ours.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <memory>

#include "body.h"

namespace bench {

/// A shape of Bullet, with its usual margin or with none. Without, casts and distances are of the
/// very shape; with it, distances of shapes with edges are of rounder ones. Null where there is but
/// one.
struct BulletBody {
  Body ours;
  std::shared_ptr<btConvexShape> without_margin, with_margin;
};

BulletBody bullet_sphere(double radius);
BulletBody bullet_box(const Vec& half_extents);
BulletBody bullet_capsule(double radius, double half_height);
BulletBody bullet_cylinder(double radius, double half_height);
BulletBody bullet_cone(double radius, double half_height);
BulletBody bullet_hull(const std::vector<Vec>& points);

btVector3 to_bullet(const Vec& v);
btTransform to_bullet(const mk::Pose& pose);

}  // namespace bench
