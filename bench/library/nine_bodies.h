// SPDX-License-Identifier: MIT
// The nine shapes whose pairs are queried in batches, as Minkray's, Bullet's and FCL's.
#pragma once

#include <fcl/fcl.h>

#include "bullet.h"

namespace bench {

/// Null where a library has no such shape, or refuses to cast it.
struct NinthBody {
  std::string name;
  mk::Shape ours;
  double radius;                                            ///< of its furthest point
  std::shared_ptr<btConvexShape> bullet, bullet_for_casts;  ///< exact but for rounding
  std::shared_ptr<fcl::CollisionGeometryd> fcl;
  bool fcl_casts = false;
};

std::vector<NinthBody> nine_bodies();

fcl::Transform3d to_fcl(const mk::Pose& pose);

}  // namespace bench
