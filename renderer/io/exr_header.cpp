// SPDX-License-Identifier: MIT
#include "renderer/io/exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace minkray {
namespace {

constexpr std::uint32_t magic_number = 20000630, multi_part_flag = 0x1000;
constexpr std::size_t longest_name = 255;

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
  /// How long a name is that ends with a zero.
  std::size_t name() {
    std::size_t length = 0;
    std::array<char, 1> byte = {};
    while ((is_whole_ = is_whole_ && length <= longest_name && read_(byte)) && byte[0] != 0)
      ++length;
    return length;
  }
  void skip(std::size_t count) {
    std::array<char, 4096> buffer;
    while (count > 0 && is_whole_) {
      const std::size_t part = std::min(count, buffer.size());
      is_whole_ = read_(std::span(buffer).first(part));
      count -= part;
    }
  }
  bool is_whole() const { return is_whole_; }

 private:
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
    if (reader.name() == 0) {
      if (!has_parts || is_first) break;
      is_first = true;
      continue;
    }
    is_first = false;
    reader.name();  // of its type
    reader.skip(reader.number());
  }
  return reader.is_whole();
}

}  // namespace minkray
