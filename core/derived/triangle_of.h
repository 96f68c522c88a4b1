// SPDX-License-Identifier: MIT
// A part of a mesh as a shape of its own.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

inline Shape triangle_of(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  return Triangle{{a, b, c}};
}

}  // namespace minkray
