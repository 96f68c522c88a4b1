// SPDX-License-Identifier: MIT
// Messages for users: parts that they must have, singly or as a table of inputs.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <initializer_list>
#include <source_location>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace minkray {

/// True if the text has the part. A failed expectation prints both.
inline ::testing::AssertionResult has(std::string_view text, std::string_view part) {
  const bool is_in = text.find(part) != text.npos;
  return ::testing::AssertionResult(is_in)
         << "\"" << part << "\"" << (is_in ? " is in\n" : " is not in\n") << text << "\n";
}

/// Expects each of the parts in the text; a failure names the caller's line.
inline void expect_parts(std::string_view text, std::initializer_list<std::string_view> parts,
                         std::source_location place = std::source_location::current()) {
  for (const std::string_view part : parts)
    if (const auto found = has(text, part); !found)
      ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line())) << found.message();
}

inline std::string in_lines(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) text += message + "\n";
  return text;
}

/// Message of the error that is thrown; "" if none is.
template <class Error = std::exception, class Work>
std::string message_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Expects of each row that read(input) has the part: one row per mistake.
template <class Input = std::string, class Read>
void expect_messages(const Read& read,
                     std::initializer_list<std::pair<Input, std::string_view>> rows,
                     std::source_location place = std::source_location::current()) {
  for (const auto& [input, part] : rows)
    if (const auto found = has(read(input), part); !found)
      ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line()))
          << found.message() << "for " << ::testing::PrintToString(input);
}

}  // namespace minkray
