// SPDX-License-Identifier: MIT
// PNG files in memory. stb_image_write is seen by png.cpp alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace minkray {

/// 8 bits a channel, red, green and blue, rows from the top.
std::vector<unsigned char> png_of(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace minkray
