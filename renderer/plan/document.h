// SPDX-License-Identifier: MIT
// A message of ROS as a file: YAML or JSON, read as one JSON value that knows its lines. Only
// document.cpp includes yaml-cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

struct Document {
  std::string file;
  Json json;
  std::string text = {};  ///< of JSON, whose lines are found when one of them is named
  /// The line of each value by its JSON pointer.
  std::unordered_map<std::string, std::size_t> lines = {};
};

/// Reads YAML, or JSON, which is known by its first character. Of several documents in a file
/// (`---`) all but one must be empty. Returns nothing, and adds mistakes, if the text is not valid.
std::optional<Document> read_document(const std::filesystem::path& file, Mistakes& mistakes);
std::optional<Document> parse_document(const std::string& text, const std::string& file,
                                       Mistakes& mistakes);

/// Calls `read` with mistakes of the document, and adds each of them with its line.
void with_lines(const Document& document, Mistakes& mistakes,
                const std::function<void(Mistakes&)>& read);

}  // namespace minkray
