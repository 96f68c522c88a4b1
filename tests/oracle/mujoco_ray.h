// SPDX-License-Identifier: MIT
// MuJoCo's ray function for its primitive shapes, in double: an answer by other people.
#pragma once

#include <optional>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::testing {

class MujocoRay {
 public:
  /// Nothing for shapes that MuJoCo does not have (it has sphere, capsule, ellipsoid, cylinder,
  /// box).
  static std::optional<MujocoRay> make(const Shape& shape);

  /// The ray's parameter where it meets the surface first, from outside or inside; infinite for no
  /// hit. The ray's t_max is ignored.
  double entry(const Ray<double>& ray) const;

 private:
  int type_ = 0;
  Vec3<double> size_ = Vec3<double>::Zero();
};

}  // namespace minkray::testing
