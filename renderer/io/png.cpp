// SPDX-License-Identifier: MIT
#include "renderer/io/png.h"

#include <fstream>
#include <stdexcept>
#include <string_view>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace minkray {
namespace {

using namespace std::string_view_literals;

/// A keyword, a zero, a text.
constexpr std::string_view software_text = "Software\0Minkray"sv;

/// The signature of 8 bytes and the chunk IHDR of 25 come first in every PNG file.
constexpr std::size_t header_bytes = 33;

/// The chunk tEXt that names the program which wrote the picture (PNG specification, 11.3.4.3),
/// behind its length and before its checksum.
std::string software_chunk() {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  std::string typed = "tEXt" + std::string(software_text);
  const std::uint32_t checksum =
      stbiw__crc32(reinterpret_cast<unsigned char*>(typed.data()), static_cast<int>(typed.size()));
  return number(static_cast<std::uint32_t>(software_text.size())) + typed + number(checksum);
}

}  // namespace

std::vector<unsigned char> png_of(int width, int height, std::span<const std::uint8_t> rgb) {
  std::vector<unsigned char> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* from = static_cast<const unsigned char*>(data);
    static_cast<std::vector<unsigned char>*>(context)->assign(from, from + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width))
    throw std::runtime_error("the PNG encoder ran out of memory");
  std::string file(bytes.begin(), bytes.end());
  file.insert(header_bytes, software_chunk());
  return {file.begin(), file.end()};
}

bool is_own_png(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string begin(header_bytes + 8 + software_text.size(), '\0');
  if (!stream.read(begin.data(), static_cast<std::streamsize>(begin.size()))) return false;
  return begin.starts_with("\x89PNG") && begin.ends_with(software_text);
}

namespace {

void append_word(std::vector<unsigned char>& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<unsigned char>(word >> shift));
}

/// A chunk: its length, name and data, and the CRC of both (PNG specification, 5.3).
void append_chunk(std::vector<unsigned char>& bytes, const char* name,
                  std::span<const unsigned char> data) {
  append_word(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = bytes.size();
  bytes.insert(bytes.end(), name, name + 4);
  bytes.insert(bytes.end(), data.begin(), data.end());
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = begin; i < bytes.size(); ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  append_word(bytes, ~crc);
}

}  // namespace

std::vector<unsigned char> png_of_grey16(int width, int height,
                                         std::span<const std::uint16_t> values) {
  // Each row begins with its filter: 0, none.
  std::vector<unsigned char> rows;
  rows.reserve(2 * values.size() + static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % static_cast<std::size_t>(width) == 0) rows.push_back(0);
    rows.push_back(static_cast<unsigned char>(values[i] >> 8));
    rows.push_back(static_cast<unsigned char>(values[i] & 255));
  }
  int size = 0;
  constexpr int quality = 8;
  unsigned char* const packed =
      stbi_zlib_compress(rows.data(), static_cast<int>(rows.size()), &size, quality);
  if (!packed) throw std::runtime_error("the PNG encoder ran out of memory");
  std::vector<unsigned char> bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<unsigned char> header;
  append_word(header, static_cast<std::uint32_t>(width));
  append_word(header, static_cast<std::uint32_t>(height));
  header.insert(header.end(), {16, 0, 0, 0, 0});  // 16 bits of grey
  append_chunk(bytes, "IHDR", header);
  append_chunk(bytes, "IDAT", {packed, static_cast<std::size_t>(size)});
  append_chunk(bytes, "IEND", {});
  STBIW_FREE(packed);
  return bytes;
}

}  // namespace minkray
