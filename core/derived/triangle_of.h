// SPDX-License-Identifier: MIT
// Converts one triangle of a mesh to a shape.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

inline Shape triangle_of(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  return Triangle{{a, b, c}};
}

}  // namespace minkray
