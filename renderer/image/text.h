// SPDX-License-Identifier: MIT
// Small text in pictures. Only text.cpp includes the font, stb_easy_font.
#pragma once

#include <string_view>

#include "renderer/image/image.h"

namespace minkray {

/// Characters are about 7 * scale pixels high; what ASCII does not have is left out.
struct TextSize {
  double width, height;
};
TextSize text_size(std::string_view text, double scale = 1);

/// Draws with the upper left corner at (x, y), in pixels; edges that fall between pixels are
/// smooth.
void draw_text(Image& image, double x, double y, std::string_view text, const Vec3<float>& colour,
               double scale = 1);

/// Blends a colour over the pixels of an axis-aligned rectangle, by how much of each it covers.
void fill_rectangle(Image& image, double x0, double y0, double x1, double y1,
                    const Vec3<float>& colour, float opacity = 1);

}  // namespace minkray
