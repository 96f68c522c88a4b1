// SPDX-License-Identifier: MIT
// Words in the syntax of POSIX shells.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace minkray {

/// Returns the text in single quotes.
inline std::string in_single_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Returns the word as it is if it needs no quotes, otherwise in single quotes.
inline std::string shell_quoted(const std::string& word) {
  const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-+=./:,@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  return is_plain ? word : in_single_quotes(word);
}

}  // namespace minkray
