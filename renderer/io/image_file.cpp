// SPDX-License-Identifier: MIT
#include "renderer/io/image_file.h"

#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "core/files/text.h"
#include "renderer/image/colour.h"
#include "renderer/io/exr.h"
#include "renderer/io/png.h"

namespace minkray {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes encode_png(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() * 3);
  for (const Vec3<float>& pixel : image.pixels)
    for (int i = 0; i < 3; ++i) rgb.push_back(to_srgb8(static_cast<double>(pixel[i])));
  return png_of(image.width, image.height, rgb);
}

/// Portable float map (Debevec): three 32-bit floats a pixel, rows from the bottom; a negative
/// scale means little-endian.
Bytes encode_pfm(const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  static_assert(sizeof(Vec3<float>) == 3 * sizeof(float));
  const std::string header =
      "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  Bytes bytes(header.begin(), header.end());
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * sizeof(Vec3<float>);
  bytes.resize(header.size() + row_bytes * static_cast<std::size_t>(image.height));
  unsigned char* to = bytes.data() + header.size();
  for (int y = image.height; y-- > 0; to += row_bytes)
    std::memcpy(to, image.at(0, y).data(), row_bytes);
  return bytes;
}

/// Just the colours. Renders have more channels: renderer/share/part_file.h.
Bytes encode_plain_exr(const Image& image) {
  const PixelRect window{0, 0, image.width, image.height};
  ExrImage exr{window, window, {}, {}};
  add_colour_planes(exr, image);
  return encode_exr(exr);
}

struct Format {
  std::string_view extension;
  bool keeps_floats;
  bool keeps_planes;
  Bytes (*encode)(const Image&);
};

constexpr std::array formats = {
    Format{".png", false, false, encode_png},
    Format{".pfm", true, false, encode_pfm},
    Format{".exr", true, true, encode_plain_exr},
};

const Format* format_of(const std::string& path) {
  for (const Format& format : formats)
    if (path.size() > format.extension.size() && path.ends_with(format.extension)) return &format;
  return nullptr;
}

}  // namespace

bool is_image_path(const std::string& path) {
  return format_of(path) != nullptr;
}

bool keeps_floats(const std::string& path) {
  const Format* format = format_of(path);
  return format != nullptr && format->keeps_floats;
}

bool keeps_planes(const std::string& path) {
  const Format* format = format_of(path);
  return format != nullptr && format->keeps_planes;
}

std::string image_extensions() {
  return listed(formats, &Format::extension);
}

std::vector<unsigned char> encode_image(const Image& image, const std::string& path) {
  const Format* format = format_of(path);
  if (format == nullptr) throw std::invalid_argument("no image format for " + path);
  return format->encode(image);
}

}  // namespace minkray
