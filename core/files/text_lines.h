// SPDX-License-Identifier: MIT
// Lines, words and numbers of mesh files in text format.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "core/math/vec.h"

namespace minkray::text_file {

/// Removes the byte order mark that some editors on Windows write at the beginning.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

/// Removes the next line from the front of the text and returns it. Lines end with \n, \r\n, or (on
/// old Macs) \r.
inline std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(std::min<std::size_t>(text.starts_with("\r\n") ? 2 : 1, text.size()));
  return line;
}

/// Removes the next word from the front of the line and returns it.
inline std::string_view next_word(std::string_view& line) {
  const std::string_view blanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

inline std::string place(std::size_t line_number) {
  return "line " + std::to_string(line_number) + ": ";
}

/// True if the complete word is a number, which may have a plus sign.
template <class Number>
bool read_number(std::string_view word, Number& number) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.begin(), word.end(), number);
  return error == std::errc() && end == word.end();
}

/// Returns the three coordinates at the front of the line.
inline Vec3<double> coordinates(std::string_view line, std::size_t line_number) {
  Vec3<double> vertex;
  for (double& coordinate : vertex) {
    if (!read_number(next_word(line), coordinate) || !std::isfinite(coordinate)) {
      throw std::runtime_error(place(line_number) + "a vertex must be three finite numbers");
    }
  }
  return vertex;
}

}  // namespace minkray::text_file
