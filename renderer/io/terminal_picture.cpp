// SPDX-License-Identifier: MIT
#include "renderer/io/terminal_picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "renderer/image/colour.h"
#include "renderer/io/png.h"

namespace minkray {
namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

Rgb8 to_rgb8(const Vec3<float>& light) {
  return {to_srgb8(static_cast<double>(light[0])), to_srgb8(static_cast<double>(light[1])),
          to_srgb8(static_cast<double>(light[2]))};
}

/// The mean light of boxes of pixels; no larger than the image.
Image shrunk(const Image& image, int width, int height) {
  Image small(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = x * image.width / width, x1 = std::max(x0 + 1, (x + 1) * image.width / width);
      const int y0 = y * image.height / height,
                y1 = std::max(y0 + 1, (y + 1) * image.height / height);
      Vec3<float> sum = Vec3<float>::Zero();
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u) sum += image.at(u, v);
      small.at(x, y) = sum / static_cast<float>((x1 - x0) * (y1 - y0));
    }
  return small;
}

Image at_most_this_wide(const Image& image, int width) {
  if (image.width <= width) return image;
  const int height =
      std::max(1, static_cast<int>(std::int64_t{image.height} * width / image.width));
  return shrunk(image, width, height);
}

/// RFC 4648, section 4.
std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// A PNG file in chunks of at most 4096 characters; the terminal fits it into the columns.
std::string kitty_picture(const Image& image, int columns) {
  std::vector<std::uint8_t> rgb;
  for (const Vec3<float>& pixel : image.pixels)
    for (const std::uint8_t channel : to_rgb8(pixel)) rgb.push_back(channel);
  const std::string text = base64(png_of(image.width, image.height, rgb));
  constexpr std::size_t chunk = 4096;
  std::string out;
  for (std::size_t i = 0; i < text.size(); i += chunk) {
    const bool is_last = i + chunk >= text.size();
    out += i == 0 ? "\x1b_Gf=100,a=T,q=2,c=" + std::to_string(columns) + ",m=" : "\x1b_Gm=";
    out += (is_last ? "0;" : "1;") + text.substr(i, chunk) + "\x1b\\";
  }
  return out + "\n";
}

/// Sixels have a palette: six levels a channel, with the error of rounding carried on along the row
/// and below it (Floyd and Steinberg, 1976).
constexpr int levels = 6;

std::vector<std::uint8_t> palette_indices(const Image& image) {
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<Vec3<float>> row(width + 2, Vec3<float>::Zero()), below = row;
  std::vector<std::uint8_t> indices;
  indices.reserve(image.pixels.size());
  for (int y = 0; y < image.height; ++y) {
    std::swap(row, below);
    std::fill(below.begin(), below.end(), Vec3<float>::Zero());
    for (int x = 0; x < image.width; ++x) {
      const auto i = static_cast<std::size_t>(x) + 1;
      const Rgb8 wanted = to_rgb8(image.at(x, y));
      int index = 0;
      for (int channel = 0; channel < 3; ++channel) {
        const float value =
            static_cast<float>(wanted[static_cast<std::size_t>(channel)]) / 255 * (levels - 1) +
            row[i][channel];
        const int level = std::clamp(static_cast<int>(std::lround(value)), 0, levels - 1);
        const float error = value - static_cast<float>(level);
        row[i + 1][channel] += error * 7 / 16;
        below[i - 1][channel] += error * 3 / 16;
        below[i][channel] += error * 5 / 16;
        below[i + 1][channel] += error * 1 / 16;
        index = index * levels + level;
      }
      indices.push_back(static_cast<std::uint8_t>(index));
    }
  }
  return indices;
}

std::string sixel_picture(const Image& image) {
  const std::vector<std::uint8_t> indices = palette_indices(image);
  std::string out =
      "\x1bPq\"1;1;" + std::to_string(image.width) + ";" + std::to_string(image.height);
  for (int index = 0; index < levels * levels * levels; ++index) {
    const auto percent = [](int level) { return std::to_string(level * 100 / (levels - 1)); };
    out += "#" + std::to_string(index) + ";2;" + percent(index / levels / levels) + ";" +
           percent(index / levels % levels) + ";" + percent(index % levels);
  }
  const auto index_at = [&](int x, int y) {
    return indices[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(x)];
  };
  for (int top = 0; top < image.height; top += 6) {  // a band of six rows, colour by colour
    const int rows = std::min(6, image.height - top);
    std::array<bool, levels * levels * levels> used{};
    for (int y = top; y < top + rows; ++y)
      for (int x = 0; x < image.width; ++x) used[index_at(x, y)] = true;
    for (int index = 0; index < levels * levels * levels; ++index) {
      if (!used[static_cast<std::size_t>(index)]) continue;
      out += "#" + std::to_string(index);
      const auto sixel = [&](int x) {
        int bits = 0;
        for (int row = 0; row < rows; ++row)
          bits |= (index_at(x, top + row) == index ? 1 : 0) << row;
        return static_cast<char>('?' + bits);
      };
      for (int x = 0; x < image.width;) {
        const char code = sixel(x);
        int count = 1;
        while (x + count < image.width && sixel(x + count) == code) ++count;
        out += count > 3 ? "!" + std::to_string(count) + code
                         : std::string(static_cast<std::size_t>(count), code);
        x += count;
      }
      out += "$";
    }
    out += "-";
  }
  return out + "\x1b\\\n";
}

/// Two pixels a character: its upper half in the colour of the text, the lower in the ground's.
std::string block_picture(const Image& image) {
  const auto colour = [](const char* what, const Rgb8& rgb) {
    return std::string("\x1b[") + what + ";2;" + std::to_string(rgb[0]) + ";" +
           std::to_string(rgb[1]) + ";" + std::to_string(rgb[2]) + "m";
  };
  std::string out;
  for (int y = 0; y < image.height; y += 2) {
    for (int x = 0; x < image.width; ++x) {
      out += colour("38", to_rgb8(image.at(x, y)));
      if (y + 1 < image.height) out += colour("48", to_rgb8(image.at(x, y + 1)));
      out += "\xe2\x96\x80";  // U+2580, upper half block
    }
    out += "\x1b[0m\n";
  }
  return out;
}

/// Approximate width of a terminal's character in pixels.
constexpr int pixels_a_column = 9;

}  // namespace

std::string terminal_picture(const Image& image, TerminalGraphics graphics, int columns) {
  if (image.pixels.empty()) return "";
  columns = std::max(columns, 1);
  switch (graphics) {
    case TerminalGraphics::kitty:
      return kitty_picture(image, std::min(columns, 1 + image.width / pixels_a_column));
    case TerminalGraphics::sixel:
      return sixel_picture(at_most_this_wide(image, columns * pixels_a_column));
    case TerminalGraphics::blocks:
      return block_picture(at_most_this_wide(image, columns));
  }
  return "";
}

}  // namespace minkray
