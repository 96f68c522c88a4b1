// SPDX-License-Identifier: MIT
// A look at the segments of JPEG files before stb_image reads them (ITU T.81, section B.2): its
// releases up to 2.27 write behind their tables of Huffman codes if a file has longer ones than the
// standard allows, and take memory and time for all pixels that a file says it has, as often as it
// says.
#pragma once

#include <string_view>

namespace minkray {

/// Throws std::runtime_error for a file that begins as JPEG files do and has a table of more than
/// 256 Huffman codes, fewer bits than squares of pixels, or more than 100 scans.
void check_jpeg(std::string_view bytes);

}  // namespace minkray
