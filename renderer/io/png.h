// SPDX-License-Identifier: MIT
// PNG files in memory. Only png.cpp includes stb_image_write.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace minkray {

/// 8 bits per channel, red, green and blue, rows from the top. A text chunk names Minkray as the
/// writer.
std::vector<unsigned char> png_of(int width, int height, std::span<const std::uint8_t> rgb);

/// True if the file is a PNG file with that text chunk.
bool is_own_png(const std::string& file);

/// Grey in 16 bits, rows from the top: numbers as they are, such as depths in millimetres.
std::vector<unsigned char> png_of_grey16(int width, int height,
                                         std::span<const std::uint16_t> values);

}  // namespace minkray
