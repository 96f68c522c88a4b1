// SPDX-License-Identifier: MIT
// A ray: the points origin + t * direction for 0 <= t <= t_max.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// Lengths are in the scene's unit; T may be a packet, with one ray per lane. The direction may
/// have any length; a direction of zero makes the ray the single point `origin`.
template <class T>
struct Ray {
  Vec3<T> origin;
  Vec3<T> direction;
  T t_max = T(std::numeric_limits<Lane<T>>::infinity());

  Vec3<T> at(T t) const { return origin + t * direction; }
};

}  // namespace minkray
