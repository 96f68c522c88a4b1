// SPDX-License-Identifier: MIT
// A look at JPEG files before stb_image reads them: its releases up to 2.27 write behind their
// tables of Huffman codes if a file has longer ones than the standard allows (ITU T.81, section
// B.2.4.2).
#pragma once

#include <string_view>

namespace minkray {

/// False for a file that begins as JPEG files do and has a table of more than 256 Huffman codes.
bool has_usable_jpeg_tables(std::string_view bytes);

}  // namespace minkray
