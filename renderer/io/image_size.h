// SPDX-License-Identifier: MIT
// Limits for the size of pictures that are read.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace minkray {

/// As many as the largest picture has that can be rendered at once.
inline constexpr std::int64_t most_image_pixels = std::int64_t{1} << 27;

/// Throws std::runtime_error. `most`: pixels that may be read, fewer than the most there are where
/// other pictures were read before.
inline void check_image_size(std::int64_t width, std::int64_t height,
                             std::int64_t most = most_image_pixels) {
  if (width < 1 || height < 1)
    throw std::runtime_error("must have pixels (got " + std::to_string(width) + " x " +
                             std::to_string(height) + ")");
  // Without their product, for which four bytes each may be too many.
  if (width > most_image_pixels / height)
    throw std::runtime_error("must have at most 2^27 pixels (got " + std::to_string(width) + " x " +
                             std::to_string(height) + ")");
  if (width > most / height)
    throw std::runtime_error(
        "all pictures of a scene together must have at most 2^27 pixels (got " +
        std::to_string(width) + " x " + std::to_string(height) + ", and those before it leave " +
        std::to_string(most) + ")");
}

}  // namespace minkray
