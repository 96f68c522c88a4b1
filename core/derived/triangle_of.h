// SPDX-License-Identifier: MIT
// A part of a mesh as a shape of its own.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

template <class T>
Shape<T> triangle_of(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
  return Triangle<T>{{a, b, c}};
}

}  // namespace minkray
