// SPDX-License-Identifier: MIT
#include "renderer/io/png_chunks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "renderer/io/image_size.h"

namespace minkray {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
/// A chunk begins with its length and name, and ends with a CRC.
constexpr std::size_t frame = 12, name_at = 4, name_length = 4, data_at = 8;
/// Bytes of a full palette: 256 colours of three bytes.
constexpr std::size_t whole_palette = 768;

/// Four bytes, the highest first.
std::int64_t number_at(std::string_view bytes, std::size_t at) {
  std::int64_t number = 0;
  for (const char byte : bytes.substr(at, 4))
    number = number * 256 + static_cast<unsigned char>(byte);
  return number;
}

/// A chunk has the length in its header, or ends with the file.
struct Chunk {
  std::size_t begin, length, end;
  std::string_view name;
};
Chunk chunk_at(std::string_view bytes, std::size_t begin) {
  const auto length = static_cast<std::size_t>(number_at(bytes, begin));
  return {begin, length, begin + std::min(frame + length, bytes.size() - begin),
          bytes.substr(begin + name_at, name_length)};
}

/// stb_image reports a PNG that is too large for it as no picture. The header has its size.
void check_size(std::string_view bytes) {
  constexpr std::size_t width_at = 16, height_at = 20, header = 24;
  if (bytes.size() < header) return;
  check_image_size(number_at(bytes, width_at), number_at(bytes, height_at));
}

/// stb_image allocates all bytes that a chunk's header claims, up to 2 GB, before it finds that
/// the file is shorter.
void check_data(std::string_view bytes) {
  for (std::size_t at = signature.size(); bytes.size() - at >= data_at;) {
    const Chunk chunk = chunk_at(bytes, at);
    if (chunk.name == "IEND") return;
    if (chunk.name == "IDAT" && data_at + chunk.length > bytes.size() - at)
      throw std::runtime_error("cannot be read: its pixels are cut off");
    at = chunk.end;
  }
}

/// Chunks without pixels are allowed. stb_image would copy one whose CRC is cut off as well.
void drop_empty_data(std::string& bytes) {
  std::size_t to = signature.size(), from = to;
  while (bytes.size() - from >= data_at) {
    const Chunk chunk = chunk_at(bytes, from);
    const std::size_t kept = chunk.length == 0 && chunk.name == "IDAT" ? 0 : chunk.end - from;
    if (to != from)
      std::copy_n(bytes.begin() + std::ptrdiff_t(from), kept, bytes.begin() + std::ptrdiff_t(to));
    to += kept;
    from = chunk.end;
  }
  bytes.erase(to, from - to);
}

/// Makes colours black that the palette has not, but pixels may name. CRCs are not read.
void complete_palette(std::string& bytes) {
  for (std::size_t at = signature.size(); bytes.size() - at >= frame;) {
    const Chunk chunk = chunk_at(bytes, at);
    at = chunk.end;
    if (chunk.name != "PLTE" || chunk.end - chunk.begin < frame + chunk.length ||
        chunk.length >= whole_palette || chunk.length % 3 != 0)
      continue;
    const std::size_t missing = whole_palette - chunk.length;
    bytes.insert(chunk.begin + data_at + chunk.length, missing, '\0');
    bytes[chunk.begin + 2] = static_cast<char>(whole_palette >> 8);
    bytes[chunk.begin + 3] = static_cast<char>(whole_palette & 0xff);
    at += missing;
  }
}

}  // namespace

void mend_png(std::string& bytes) {
  if (!bytes.starts_with(signature)) return;
  check_size(bytes);
  check_data(bytes);
  drop_empty_data(bytes);
  complete_palette(bytes);
}

}  // namespace minkray
