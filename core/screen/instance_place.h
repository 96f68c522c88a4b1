// SPDX-License-Identifier: MIT
// Compact pose of an instance, for kernels. The leading digits fit in one cache line and suffice
// for nearly all queries; the trailing digits make the map exact.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// The map x -> to_inner (x - origin), from the world to the frame of an InstanceBody.
struct alignas(64) InstancePlace {
  double origin[3];
  float to_inner[9];   ///< column by column, rounded to nearest
  std::uint32_t body;  ///< index of the InstanceBody; no_body, or another special value, for
                       ///< instances without a body
};
static_assert(sizeof(InstancePlace) == 64);

inline constexpr std::uint32_t no_body = std::numeric_limits<std::uint32_t>::max();

/// Differences between the exact map and the rounded one, in units in the last place.
struct TrailingDigits {
  std::int32_t of[9];
};

/// Splits a number into a float and the difference from it, in units in the last place. Returns
/// false if the number is outside the range of float or subnormal in float.
inline bool split(double x, float& leading, std::int32_t& trailing) {
  leading = static_cast<float>(x);
  const float size = std::abs(leading);
  if (x != 0 &&
      !(size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max()))
    return false;
  trailing = static_cast<std::int32_t>(std::bit_cast<std::int64_t>(x) -
                                       std::bit_cast<std::int64_t>(static_cast<double>(leading)));
  return true;
}

inline double joined(float leading, std::int32_t trailing) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(static_cast<double>(leading)) +
                               trailing);
}

}  // namespace minkray
