// SPDX-License-Identifier: MIT
// Checks JPEG segments (ITU T.81, section B.2) before stb_image reads them. Releases up to 2.27
// write beyond their Huffman tables if a file's are too long, and spend memory and time on all
// pixels that a file claims, once per claim.
#pragma once

#include <string_view>

namespace minkray {

/// Throws std::runtime_error for a file that begins as JPEG files do and has a table of more than
/// 256 Huffman codes, fewer bits than squares of pixels, or more than 100 scans.
void check_jpeg(std::string_view bytes);

}  // namespace minkray
