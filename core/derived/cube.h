// SPDX-License-Identifier: MIT
// A box with equal sides, for what has a flat face and no shape of its own.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// A cube around the origin, with sides of twice that length.
inline Shape cube_of(double half) {
  return Box{Vec3<double>::Constant(half)};
}

}  // namespace minkray
