// SPDX-License-Identifier: MIT
// The sRGB transfer functions (IEC 61966-2-1) and 8-bit rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace minkray {

/// Maps linear light to the encoded value, [0, 1] to [0, 1].
inline double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Maps the encoded value to linear light.
inline double from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The nearest 8-bit code of linear light, clipped to what a screen can show. NaN becomes 0.
inline std::uint8_t to_srgb8(double linear) {
  const double clipped = linear > 0 ? std::min(linear, 1.0) : 0.0;
  return static_cast<std::uint8_t>(std::lround(255 * to_srgb(clipped)));
}

}  // namespace minkray
