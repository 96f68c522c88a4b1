// SPDX-License-Identifier: MIT
#include "renderer/image/text.h"

#include <algorithm>
#include <string>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace minkray {
namespace {

/// The library writes into what it is given, and reads beyond its table outside of ASCII.
std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c >= ' ' && c <= '~') result.push_back(c);
  return result;
}

}  // namespace

TextSize text_size(std::string_view text, double scale) {
  std::string copy = printable(text);
  return {stb_easy_font_width(copy.data()) * scale, 9 * scale};
}

void fill_rectangle(Image& image, double x0, double y0, double x1, double y1,
                    const Vec3<float>& colour, float opacity) {
  // Clipped first: positions far outside are no int.
  x0 = std::clamp(x0, 0.0, static_cast<double>(image.width));
  x1 = std::clamp(x1, 0.0, static_cast<double>(image.width));
  y0 = std::clamp(y0, 0.0, static_cast<double>(image.height));
  y1 = std::clamp(y1, 0.0, static_cast<double>(image.height));
  for (int y = static_cast<int>(y0); y < y1; ++y) {
    const double height = std::min(y1, y + 1.0) - std::max(y0, static_cast<double>(y));
    for (int x = static_cast<int>(x0); x < x1; ++x) {
      const double width = std::min(x1, x + 1.0) - std::max(x0, static_cast<double>(x));
      const float cover = static_cast<float>(width * height) * opacity;
      Vec3<float>& pixel = image.at(x, y);
      pixel += cover * (colour - pixel);
    }
  }
}

void draw_text(Image& image, double x, double y, std::string_view text, const Vec3<float>& colour,
               double scale) {
  struct Vertex {
    float x, y, z;
    unsigned char colour[4];
  };
  std::string copy = printable(text);
  // The library's own estimate: some 270 bytes a character.
  std::vector<Vertex> vertices((copy.size() + 1) * 40);
  const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(Vertex)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(quads); ++i) {
    const Vertex& a = vertices[4 * i];
    const Vertex& c = vertices[4 * i + 2];
    fill_rectangle(image, x + a.x * scale, y + a.y * scale, x + c.x * scale, y + c.y * scale,
                   colour);
  }
}

}  // namespace minkray
