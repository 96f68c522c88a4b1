// SPDX-License-Identifier: MIT
// Reads pictures as linear RGB: OpenEXR, Radiance's .hdr, PNG (8 and 16 bits) and JPEG, colour or
// grey. Only read_image.cpp includes stb_image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/io/image_size.h"

namespace minkray {

/// The extensions, for messages.
inline constexpr const char* readable_images = ".exr, .hdr, .png, .jpg";

/// Throws std::runtime_error with the reason for a file that cannot be used: also one with numbers
/// that are negative or not finite, or with more pixels than `most_pixels`.
Image read_image(const std::filesystem::path& file, std::int64_t most_pixels = most_image_pixels);

/// Reads a PNG or JPEG that lies in memory.
Image read_image_bytes(std::string bytes, std::int64_t most_pixels = most_image_pixels);

/// Grey levels as their codes have them, rows from the top: of 8 or 16 bits from 0 to 1, of OpenEXR
/// and Radiance the red numbers as they are.
struct GreyLevels {
  int width = 0, height = 0;
  std::vector<float> levels;
};
GreyLevels read_grey(const std::filesystem::path& file,
                     std::int64_t most_pixels = most_image_pixels);

}  // namespace minkray
