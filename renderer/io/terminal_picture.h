// SPDX-License-Identifier: MIT
// Encodes pictures for terminals: kitty's graphics protocol
// (sw.kovidgoyal.net/kitty/graphics-protocol), sixels (DEC VT340, STD 070), or half blocks, for
// every terminal with colours.
#pragma once

#include <string>

#include "renderer/image/image.h"

namespace minkray {

enum class TerminalGraphics : unsigned char { kitty, sixel, blocks };

/// Linear light, shown as `columns` characters wide at most. Ends with a line's end.
std::string terminal_picture(const Image& image, TerminalGraphics graphics, int columns);

}  // namespace minkray
