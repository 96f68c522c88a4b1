// SPDX-License-Identifier: MIT
// Does a ray meet an axis-aligned box? The slab test, padded after Ize, "Robust BVH Ray Traversal"
// (2013), so that rounding never loses a box that the exact ray meets.
#pragma once

#include <array>

#include "core/math/ray.h"
#include "core/math/vec.h"

namespace minkray {

/// A ray made ready for many slab tests. Its origin and direction must be finite; components of the
/// direction may be zero (also -0), all of them too: such a ray is a single point.
template <class T>
struct SlabRay {
  std::array<T, 3> origin;
  std::array<T, 3> inverse;  ///< 1 / direction: infinite where the direction has no component
  std::array<int, 3> near;   ///< which plane comes first: 0 the lower, 1 the upper

  explicit SlabRay(const Ray<T>& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      origin[i] = ray.origin[axis];
      inverse[i] = T(1) / ray.direction[axis];
      near[i] = inverse[i] < T(0) ? 1 : 0;
    }
  }
};

/// A plane's parameter (plane - origin) * inverse is rounded three times: relative error
/// gamma = 3u / (1 - 3u), u half the machine epsilon. Twice that, for two planes compared with each
/// other, and one more rounding for the product: 1 + 2 gamma + u < 1 + 4 epsilon.
template <class T>
inline constexpr T slab_padding = T(1) + T(4) * std::numeric_limits<T>::epsilon();

/// Where the ray enters the box, or infinity if it does not meet it with 0 <= t <= t_max.
/// `planes[0]` is the lower corner, `planes[1]` the upper; the box is closed, and may be flat.
template <class T, class B>
T slab_entry(const SlabRay<T>& ray, const B (&planes)[2][3], T t_max) {
  T enter = T(0), leave = t_max;
  for (std::size_t i = 0; i < 3; ++i) {
    const T first = (T(planes[ray.near[i]][i]) - ray.origin[i]) * ray.inverse[i];
    const T last = (T(planes[1 - ray.near[i]][i]) - ray.origin[i]) * ray.inverse[i];
    // A ray within a plane gives 0 * infinity = NaN: both comparisons are written so that it falls
    // through and the plane does not limit the ray.
    enter = first > enter ? first : enter;
    leave = last < leave ? last : leave;
  }
  return enter <= leave * slab_padding<T> ? enter : std::numeric_limits<T>::infinity();
}

}  // namespace minkray
