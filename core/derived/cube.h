// SPDX-License-Identifier: MIT
// A box with equal sides, for what has a flat face and no shape of its own.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// A cube around the origin, with sides of twice that length.
template <class T>
Shape<T> cube_of(T half) {
  return Box<T>{Vec3<T>::Constant(half)};
}

}  // namespace minkray
