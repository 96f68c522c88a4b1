// SPDX-License-Identifier: MIT
// Image files. Only image_file.cpp lists the formats.
#pragma once

#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace minkray {

/// True if the path's extension belongs to a format.
bool is_image_path(const std::string& path);

/// True if the path's format keeps the numbers as they are (linear, unclipped).
bool keeps_floats(const std::string& path);

/// True if the path's format keeps any number of named planes and texts (renderer/io/exr.h).
bool keeps_planes(const std::string& path);

/// The extensions, for messages: ".png, .pfm, .exr".
std::string image_extensions();

/// The file's bytes, in the format that belongs to the path's extension.
std::vector<unsigned char> encode_image(const Image& image, const std::string& path);

}  // namespace minkray
