// SPDX-License-Identifier: MIT
// Little-endian numbers and texts, appended to a file's bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace minkray {

static_assert(std::endian::native == std::endian::little);

using FileBytes = std::vector<unsigned char>;

template <class Number>
void put(FileBytes& bytes, const Number& number) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof number);
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

inline void put_text(FileBytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// Appends characters, then zeros up to the size.
inline void put_text(FileBytes& bytes, std::string_view text, std::size_t size) {
  put_text(bytes, text.substr(0, size));
  bytes.resize(bytes.size() + size - text.substr(0, size).size());
}

}  // namespace minkray
