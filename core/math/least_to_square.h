// SPDX-License-Identifier: MIT
// Range in which the square of a type's numbers is representable.
#pragma once

#include <limits>
#include <type_traits>

namespace minkray {

/// Least number whose square is a normal number. The square of its inverse is finite.
template <class T>
inline constexpr T least_to_square = std::is_same_v<T, float> ? T(0x1p-63) : T(0x1p-511);
static_assert(least_to_square<float> * least_to_square<float> == std::numeric_limits<float>::min());
static_assert(least_to_square<double> * least_to_square<double> ==
              std::numeric_limits<double>::min());

}  // namespace minkray
