// SPDX-License-Identifier: MIT
// A box with equal sides, which represents the part of a half-space near a body.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// A cube around the origin with the half extent `half`.
inline Shape cube_of(double half) {
  return Box{Vec3<double>::Constant(half)};
}

}  // namespace minkray
