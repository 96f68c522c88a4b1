// SPDX-License-Identifier: MIT
// Comments are sentences: none starts with "Of ..." or "The same ...", which have no verb to
// follow.
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "tests/support/source_files.h"

namespace minkray {
namespace {

constexpr std::array<std::string_view, 2> verbless = {"Of ", "The same"};

/// Counts the lines of comments of their own; adds the verbless ones to `found`.
std::size_t look_at_comments(std::string_view text, std::vector<std::string>& found) {
  std::size_t count = 0;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string_view::npos || !line.substr(begin).starts_with("//")) continue;
    ++count;
    const std::size_t word = line.find_first_not_of("/ ", begin);
    if (word == std::string_view::npos) continue;
    for (const std::string_view start : verbless)
      if (line.substr(word).starts_with(start)) found.emplace_back(line);
  }
  return count;
}

TEST(Comments, that_have_no_verb_are_found) {
  std::vector<std::string> found;
  EXPECT_EQ(
      look_at_comments("int a;\n\n  /// Of a ball.\n// A ball.\n/// Offers.\nint b;  ///< Of b\n"
                       "// The same\n",
                       found),
      4u);
  EXPECT_EQ(found, (std::vector<std::string>{"  /// Of a ball.", "// The same"}));
}

TEST(Comments, have_a_verb) {
  std::size_t count = 0;
  for (const char* folder : {"core", "renderer", "include", "tests", "bench"}) {
    if (!std::filesystem::exists(source_folder() / folder)) continue;
    for (const SourceFile& file : files_in(folder)) {
      if (!file.name.ends_with(".h") && !file.name.ends_with(".cpp") &&
          !file.name.ends_with(".inl"))
        continue;
      std::vector<std::string> found;
      count += look_at_comments(file.text, found);
      for (const std::string& line : found)
        ADD_FAILURE() << file.name << ": no verb follows in: " << line;
    }
  }
  EXPECT_GT(count, 1000u);  // the test has found the comments
}

}  // namespace
}  // namespace minkray
