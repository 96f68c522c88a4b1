// SPDX-License-Identifier: MIT
// Poses that only shift.
#pragma once

#include "core/math/affine.h"

namespace minkray {

inline Affine<double> shifted_by(const Vec3<double>& by) {
  return {Mat3<double>::Identity(), by};
}
inline Affine<double> shifted_by(double x, double y, double z) {
  return {Mat3<double>::Identity(), {x, y, z}};
}

}  // namespace minkray
