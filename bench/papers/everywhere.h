// SPDX-License-Identifier: MIT
// Shapes and poses in the words of Minkray, Bullet and FCL.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <fcl/fcl.h>

#include <memory>
#include <vector>

#include "core/math/affine.h"
#include "core/shape/shape.h"

namespace minkray::bench {

/// One shape in every library's words.
struct Everywhere {
  const char* name;
  Shape ours;
  std::shared_ptr<btConvexShape> bullet;
  std::shared_ptr<fcl::CollisionGeometryd> fcl;  ///< null: not compared
};

std::vector<Everywhere> make_shapes();

btTransform to_bullet(const Affine<double>& pose);
fcl::Transform3d to_fcl(const Affine<double>& pose);

}  // namespace minkray::bench
