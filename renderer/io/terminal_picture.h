// SPDX-License-Identifier: MIT
// Pictures as the bytes that make a terminal show them: the graphics protocol of kitty
// (sw.kovidgoyal.net/kitty/graphics-protocol), sixels (DEC VT340, STD 070), or half blocks, which
// every terminal with colours has.
#pragma once

#include <string>

#include "renderer/image/image.h"

namespace minkray {

enum class TerminalGraphics : unsigned char { kitty, sixel, blocks };

/// Linear light, shown as `columns` characters wide at most. Ends with a line's end.
std::string terminal_picture(const Image& image, TerminalGraphics graphics, int columns);

}  // namespace minkray
