// SPDX-License-Identifier: MIT
// Reads Radiance pictures (.hdr): four bytes per pixel, three numbers and their common exponent,
// plain or run-length encoded (Ward, Real Pixels, Graphics Gems II, 1991). stb_image reads them
// too, but release 2.27 reads past the end of a file.
#pragma once

#include <cstdint>
#include <string_view>

#include "renderer/image/image.h"
#include "renderer/io/image_size.h"

namespace minkray {

/// Throws std::runtime_error, with what was expected and found, if it is no such picture, cut off,
/// or of more pixels than may be read.
Image read_radiance(std::string_view bytes, std::int64_t most_pixels = most_image_pixels);

}  // namespace minkray
