// SPDX-License-Identifier: MIT
// Shapes under maps.
#pragma once

#include "core/shape/shape.h"

namespace minkray::testing {

inline Affine<double> moved(const Vec3<double>& by) {
  return {Mat3<double>::Identity(), by};
}

inline Shape mapped(const Shape& shape, const Affine<double>& map) {
  return Transform{shape, map};
}

}  // namespace minkray::testing
