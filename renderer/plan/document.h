// SPDX-License-Identifier: MIT
// A ROS message as a file: YAML or JSON, read as one JSON value that stores its lines. Only
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
  std::string text = {};  ///< source of JSON, whose lines are searched for only if one of them is
                          ///< needed
  /// Line of each value, by its JSON pointer.
  std::unordered_map<std::string, std::size_t> lines = {};
};

/// Reads YAML or JSON, which the first character identifies. If a file has several documents
/// (`---`), all but one must be empty. Returns nothing, and adds mistakes, if the text is not
/// valid.
std::optional<Document> read_document(const std::filesystem::path& file, Mistakes& mistakes);
std::optional<Document> parse_document(const std::string& text, const std::string& file,
                                       Mistakes& mistakes);

/// Calls `read`, which adds mistakes of the document, and adds each of them with its line.
void with_lines(const Document& document, Mistakes& mistakes,
                const std::function<void(Mistakes&)>& read);

}  // namespace minkray
