// SPDX-License-Identifier: MIT
#include "renderer/io/exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace minkray {
namespace {

constexpr std::uint32_t magic_number = 20000630, multi_part_flag = 0x1000;
constexpr std::size_t longest_name = 255;

/// Values of these types are read by their type, whatever length the file gives: with another
/// length, the data behind them would be read differently here.
struct TypeOfOneLength {
  std::string_view name;
  std::uint32_t length;
};
constexpr std::array types_of_one_length = {TypeOfOneLength{"box2f", 16},
                                            TypeOfOneLength{"box2i", 16},
                                            TypeOfOneLength{"chromaticities", 32},
                                            TypeOfOneLength{"compression", 1},
                                            TypeOfOneLength{"deepImageState", 1},
                                            TypeOfOneLength{"double", 8},
                                            TypeOfOneLength{"envmap", 1},
                                            TypeOfOneLength{"float", 4},
                                            TypeOfOneLength{"int", 4},
                                            TypeOfOneLength{"keycode", 28},
                                            TypeOfOneLength{"lineOrder", 1},
                                            TypeOfOneLength{"m33d", 72},
                                            TypeOfOneLength{"m33f", 36},
                                            TypeOfOneLength{"m44d", 128},
                                            TypeOfOneLength{"m44f", 64},
                                            TypeOfOneLength{"rational", 8},
                                            TypeOfOneLength{"tiledesc", 9},
                                            TypeOfOneLength{"timecode", 8},
                                            TypeOfOneLength{"v2d", 16},
                                            TypeOfOneLength{"v2f", 8},
                                            TypeOfOneLength{"v2i", 8},
                                            TypeOfOneLength{"v3d", 24},
                                            TypeOfOneLength{"v3f", 12},
                                            TypeOfOneLength{"v3i", 12}};
/// A list of channels ends with an empty name; each channel has this many bytes behind its name.
constexpr std::string_view type_of_channels = "chlist";
constexpr std::uint32_t channel_bytes = 16;

class Reader {
 public:
  explicit Reader(const ReadOn& read) : read_(read) {}

  std::uint32_t number() {
    std::array<char, 4> bytes = {};
    is_whole_ = is_whole_ && read_(bytes);
    std::uint32_t number = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
      number = number * 256 + static_cast<unsigned char>(bytes[i]);
    return number;
  }
  /// Reads a text that ends with a zero.
  std::string name() {
    std::string name;
    std::array<char, 1> byte = {};
    while ((is_whole_ = is_whole_ && name.size() <= longest_name && read_(byte)) && byte[0] != 0)
      name += byte[0];
    return name;
  }
  void skip(std::size_t count) {
    std::array<char, 4096> buffer;
    while (count > 0 && is_whole_) {
      const std::size_t part = std::min(count, buffer.size());
      is_whole_ = read_(std::span(buffer).first(part));
      count -= part;
    }
  }
  /// An attribute's value, which must end at the length in the file.
  void value(std::string_view type, std::uint32_t length) {
    const auto* fixed = std::ranges::find(types_of_one_length, type, &TypeOfOneLength::name);
    if (fixed != types_of_one_length.end() && length != fixed->length) is_whole_ = false;
    // The library reads whole numbers only of the one, and four bytes more than it has of the
    // other.
    if ((type == "floatvector" && length % sizeof(float) != 0) || type == "idmanifest")
      is_whole_ = false;
    if (type == type_of_channels)
      channels(length);
    else
      skip(length);
  }
  bool is_whole() const { return is_whole_; }

 private:
  void channels(std::uint32_t length) {
    std::uint64_t read = 1;
    for (std::string channel; is_whole_ && !(channel = name()).empty();) {
      skip(channel_bytes);
      read += channel.size() + 1 + channel_bytes;
    }
    is_whole_ = is_whole_ && read == length;
  }

  const ReadOn& read_;
  bool is_whole_ = true;
};

}  // namespace

bool has_whole_exr_attributes(const ReadOn& read) {
  Reader reader(read);
  if (reader.number() != magic_number) return true;
  const bool has_parts = (reader.number() & multi_part_flag) != 0;
  // A header ends with an empty name; of several parts, the last with two.
  for (bool is_first = true; reader.is_whole();) {
    if (reader.name().empty()) {
      if (!has_parts || is_first) break;
      is_first = true;
      continue;
    }
    is_first = false;
    const std::string type = reader.name();
    reader.value(type, reader.number());
  }
  return reader.is_whole();
}

}  // namespace minkray
