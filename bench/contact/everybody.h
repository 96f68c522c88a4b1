// SPDX-License-Identifier: MIT
// The nine shapes whose pairs are compared, in every library's types, and their poses.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <fcl/fcl.h>
#include <ode/ode.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/pair/contact_shape.h"

namespace minkray::bench {

/// Null or empty: the library has no such shape.
struct Everybody {
  std::string name;
  Shape ours;
  ContactShape ready;
  std::shared_ptr<btConvexShape> bullet;
  /// The one to cast: a rounded box is a hull there, since casts take a box' margin for sharp
  /// edges.
  std::shared_ptr<btConvexShape> bullet_for_casts;
  std::shared_ptr<fcl::CollisionGeometryd> fcl;
  std::function<dGeomID()> ode;
  std::string mujoco, mujoco_mesh = {};  ///< the attributes of its geom; its vertices

  bool is_curved() const {
    return name == "cylinder" || name == "cone" || name == "ellipsoid" || name == "sphere" ||
           name == "capsule" || name == "rounded box";
  }
  bool is_hull() const { return name.starts_with("hull"); }
};

std::vector<Everybody> everybody();

btTransform to_bullet(const Affine<double>& pose);
fcl::Transform3d to_fcl(const Affine<double>& pose);

/// A is at the origin. B is at its pose, and moves from there by `motion`.
struct Placement {
  Affine<double> a, b;
  Vec3<double> motion;
};

/// Half of them apart, a fifth within 1e-6 of touching, the others overlap.
std::vector<Placement> placements(const Everybody& a, const Everybody& b, std::size_t count);

}  // namespace minkray::bench
