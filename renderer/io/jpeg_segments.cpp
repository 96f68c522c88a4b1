// SPDX-License-Identifier: MIT
#include "renderer/io/jpeg_segments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace minkray {
namespace {

constexpr unsigned first_frame = 0xc0, last_frame = 0xc2;  ///< of those that stb_image reads
constexpr unsigned huffman_tables = 0xc4, scan = 0xda;
constexpr std::size_t lengths =
    16;  ///< lengths of codes, in bits: a table has the number of codes of each
constexpr std::size_t most_codes = 256;
/// Each may go over all of the picture with a few bytes. Programs write ten at most.
constexpr int most_scans = 100;
constexpr std::uint64_t block_side = 8;  ///< of the squares of pixels that are coded together

/// The bytes from a place on; those behind the end are zero, as stb_image has it.
class From {
 public:
  From(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t at() const { return at_; }
  unsigned byte() { return at_end() ? 0 : static_cast<unsigned char>(bytes_[at_++]); }
  /// A number of two bytes, such as how long a segment is with them.
  std::size_t number() {
    const std::size_t high = byte();
    return high * 256 + byte();
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
};

/// Checks the tables of a segment whose length is at `at`.
bool are_usable(std::string_view bytes, std::size_t at) {
  From from(bytes, at);
  const std::size_t length = from.number();
  const std::size_t end = at + length;
  while (from.at() < end && !from.at_end()) {
    from.byte();  // number of the table
    std::size_t codes = 0;
    for (std::size_t i = 0; i < lengths; ++i) codes += from.byte();
    if (codes > most_codes) return false;
    for (; codes > 0 && !from.at_end(); --codes) from.byte();
  }
  return true;
}

/// Least number of blocks in the picture of a frame whose length is at `at`.
std::uint64_t least_blocks(std::string_view bytes, std::size_t at) {
  From from(bytes, at);
  from.number();
  from.byte();  // bits of a number
  const std::uint64_t height = from.number(), width = from.number();
  struct Sampling {
    std::uint64_t across, down;
  };
  std::array<Sampling, 4> components = {};
  const std::size_t count = std::min<std::size_t>(from.byte(), components.size());
  Sampling most = {1, 1};
  for (std::size_t i = 0; i < count; ++i) {
    from.byte();  // name
    const unsigned sampling = from.byte();
    from.byte();  // table
    components[i] = {sampling >> 4, sampling & 15};
    most = {std::max(most.across, components[i].across), std::max(most.down, components[i].down)};
  }
  std::uint64_t blocks = 0;
  for (const Sampling& component : components)
    blocks += width * component.across / (block_side * most.across) *
              (height * component.down / (block_side * most.down));
  return blocks;
}

}  // namespace

void check_jpeg(std::string_view bytes) {
  if (!bytes.starts_with('\xff')) return;
  // Segments by their lengths, up to the first scan; bytes between them are passed over.
  From from(bytes, 0);
  int scans = 0;
  while (!from.at_end()) {
    if (from.byte() != 0xff) continue;
    unsigned marker = 0xff;
    while (marker == 0xff && !from.at_end()) marker = from.byte();
    if (marker == huffman_tables && !are_usable(bytes, from.at()))
      throw std::runtime_error("cannot be read: a table of more than 256 Huffman codes");
    // A block has one bit at least.
    if (marker >= first_frame && marker <= last_frame &&
        least_blocks(bytes, from.at()) > 8 * std::uint64_t{bytes.size()})
      throw std::runtime_error("cannot be read: it has fewer bytes than its pixels need");
    if (marker == scan && ++scans > most_scans)
      throw std::runtime_error("cannot be read: must have at most 100 scans");
    // In a scan's data nothing has a length; the first marker, which begins the file, has none.
    constexpr unsigned begin = 0xd8;
    if (scans > 0 || marker == begin) continue;
    From next = from;
    const std::size_t length = next.number();
    from = From(bytes, from.at() + (length < 2 ? 2 : length));
  }
}

}  // namespace minkray
