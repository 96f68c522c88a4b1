// SPDX-License-Identifier: MIT
// Requirements on a convex shape: its support mapping, and nothing else.
#pragma once

#include <concepts>

#include "core/math/vec.h"

namespace minkray {

/// `shape.support(n)` returns a point s of the shape with n.s >= n.x for all points x of the shape.
/// n may have any length; for n = 0, the result may be any point of the shape.
template <class S, class T>
concept SupportMapped = requires(const S& shape, const Vec3<T>& n) {
  { shape.support(n) } -> std::convertible_to<Vec3<T>>;
};

}  // namespace minkray
