// SPDX-License-Identifier: MIT
// Strict JSON parser. Duplicate keys, numbers beyond double, NaN, Infinity and too deep nesting are
// errors with a location.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Largest depth of nested lists and objects: far beyond the needs of scenes, far below the
/// capacity of the stack.
inline constexpr std::size_t deepest_json_nesting = 256;

/// Some million objects. The values take about twenty times as much memory as the text.
inline constexpr std::size_t most_json_bytes = std::size_t{256} << 20;

/// The value, with null in the place of numbers that are not finite. Nothing if the text cannot be
/// read to its end; whatever is wrong with it is added to the mistakes.
std::optional<Json> parse_json(std::string_view text, Mistakes& mistakes);

/// A text without its comments.
struct Uncommented {
  std::string text;           ///< blanks in their place: all else keeps its line and column
  std::string first_comment;  ///< "line:column" of the first one; empty if there is none
};

/// Takes comments away that go from // to the end of their line.
Uncommented without_comments(std::string_view text);

/// The contents of a file; nothing, and a mistake, if it cannot be read,
/// is no regular file (pipes do not end), or is too large.
std::optional<std::string> read_text_file(const std::filesystem::path& path, Mistakes& mistakes);

}  // namespace minkray
