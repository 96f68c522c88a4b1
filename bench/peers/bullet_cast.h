// SPDX-License-Identifier: MIT
// Bullet's btSubsimplexConvexCast, as its btCollisionWorld::rayTest uses it: a point cast at a
// convex shape, with Bullet's default margins and its own absolute tolerances.
#pragma once

#include <memory>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::bench {

class BulletCast {
 public:
  /// Nothing for shapes that Bullet does not have.
  static std::unique_ptr<BulletCast> make(const Shape<double>& shape);
  ~BulletCast();

  /// The ray's parameter at the hit, for 0 <= t <= t_max, which must be finite; infinite for none.
  float entry(const Ray<float>& ray) const;

 private:
  struct State;
  explicit BulletCast(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace minkray::bench
