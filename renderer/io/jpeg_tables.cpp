// SPDX-License-Identifier: MIT
#include "renderer/io/jpeg_tables.h"

#include <cstddef>

namespace minkray {
namespace {

constexpr unsigned huffman_tables = 0xc4, scan = 0xda;
constexpr std::size_t lengths = 16;  ///< of codes, in bits: a table says how many codes have each
constexpr std::size_t most_codes = 256;

/// The bytes from a place on; those behind the end are zero, as stb_image has it.
class From {
 public:
  From(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t at() const { return at_; }
  unsigned byte() { return at_end() ? 0 : static_cast<unsigned char>(bytes_[at_++]); }
  /// How long a segment is with these two bytes.
  std::size_t length() {
    const std::size_t high = byte();
    return high * 256 + byte();
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
};

/// The tables of a segment whose length stands at `at`.
bool are_usable(std::string_view bytes, std::size_t at) {
  From from(bytes, at);
  std::size_t length = from.length();
  const std::size_t end = at + length;
  while (from.at() < end && !from.at_end()) {
    from.byte();  // which table it is
    std::size_t codes = 0;
    for (std::size_t i = 0; i < lengths; ++i) codes += from.byte();
    if (codes > most_codes) return false;
    for (; codes > 0 && !from.at_end(); --codes) from.byte();
  }
  return true;
}

}  // namespace

bool has_usable_jpeg_tables(std::string_view bytes) {
  if (!bytes.starts_with('\xff')) return true;
  // Segments by their lengths, up to the first scan; bytes between them are passed over.
  From from(bytes, 0);
  bool in_scan = false;
  while (!from.at_end()) {
    if (from.byte() != 0xff) continue;
    unsigned marker = 0xff;
    while (marker == 0xff && !from.at_end()) marker = from.byte();
    if (marker == huffman_tables && !are_usable(bytes, from.at())) return false;
    in_scan = in_scan || marker == scan;
    // In a scan's data nothing has a length; the first marker, which begins the file, has none.
    constexpr unsigned begin = 0xd8;
    if (in_scan || marker == begin) continue;
    From next = from;
    const std::size_t length = next.length();
    from = From(bytes, from.at() + (length < 2 ? 2 : length));
  }
  return true;
}

}  // namespace minkray
