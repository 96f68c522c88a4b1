// SPDX-License-Identifier: MIT
// Pose of an instance, in as few bytes as kernels can read: the leading digits, one cache line,
// suffice for nearly all queries; the trailing ones make the map exact.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// x -> to_inner (x - origin) leads from the world to the frame of an InstanceBody.
struct alignas(64) InstancePlace {
  double origin[3];
  float to_inner[9];   ///< column by column, rounded to nearest
  std::uint32_t body;  ///< index of the InstanceBody, or a number of what has none
};
static_assert(sizeof(InstancePlace) == 64);

inline constexpr std::uint32_t no_body = std::numeric_limits<std::uint32_t>::max();

/// Units in the last place by which the exact map differs from the rounded one.
struct TrailingDigits {
  std::int32_t of[9];
};

/// Splits a number into a float and the units in the last place that it differs by. False if float
/// has no such number: beyond its range, or so small that it has fewer digits.
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
