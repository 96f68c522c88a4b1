// SPDX-License-Identifier: MIT
// Checks the words of comments: each starts with a verb or a noun and uses the usual verb. A head
// comment has at most five lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/source_files.h"

namespace minkray {
namespace {

struct OddWords {
  int starts = 0;  ///< comments and sentences without a verb or noun at their start
  int words = 0;   ///< words with a more usual one
  bool operator==(const OddWords&) const = default;
};

constexpr int most_head_lines = 5;

constexpr std::array starts_of_no_sentence = {"What ", "Whether ", "Who ", "It ", "They ", "Of "};
constexpr std::array starts_of_no_comment = {"Where ", "Whose ",   "That ",  "Its ",      "So ",
                                             "By ",    "How ",     "Which ", "The same ", "what ",
                                             "where ", "who ",     "they ",  "whose ",    "it ",
                                             "its ",   "whether ", "how ",   "which "};

/// Usual words are report, query, is, check, continue, fail, next to, again, N, via, instead of.
constexpr std::array odd_words = {
    "anew",      "anybody", "ask",       "asked",    "asking",     "asks",    "beside",
    "by way of", "gave up", "give up",   "gives up", "go on",      "goes on", "in place of",
    "knows",     "look at", "looked at", "looks at", "made ready", "nobody",  "of which",
    "said",      "say",     "says",      "so many",  "stand",      "stands",  "stood",
    "tell",      "telling", "tells",     "told",     "whoever"};

bool is_blank(std::string_view text) {
  return text.find_first_not_of(' ') == std::string_view::npos;
}

/// Position of a line's comment; npos if it has none.
std::size_t comment_in(std::string_view line) {
  bool is_quoted = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (line[i] == '\\')
      ++i;
    else if (line[i] == '"' && (i == 0 || line[i - 1] != '\''))
      is_quoted = !is_quoted;
    else if (!is_quoted && line[i] == '/' && (line[i + 1] == '/' || line[i + 1] == '*'))
      return i;
  }
  return std::string_view::npos;
}

/// All comments of a source, each in one line: lines below each other are one comment.
std::vector<std::string> comments_of(std::string_view source) {
  constexpr std::string_view license = "SPDX-License-Identifier: MIT ";
  std::vector<std::string> comments;
  std::size_t column = std::string_view::npos;  // of the line before
  bool is_open = false;                         // in /* */
  while (!source.empty()) {
    const std::string_view line = source.substr(0, source.find('\n'));
    source.remove_prefix(std::min(source.size(), line.size() + 1));
    const std::size_t at = is_open ? 0 : comment_in(line);
    const bool continues = is_open || (at == column && is_blank(line.substr(0, at)));
    column = at;
    if (at == std::string_view::npos) continue;
    if (!is_open) is_open = line[at + 1] == '*';
    std::string_view text = line.substr(std::min(line.size(), line.find_first_not_of("/*!< ", at)));
    if (const std::size_t end = text.find("*/"); is_open && end != std::string_view::npos) {
      text = text.substr(0, end);
      is_open = false;
      column = std::string_view::npos;
    } else if (is_open && line.ends_with("*/")) {
      is_open = false;
    }
    if (!continues) comments.emplace_back();
    comments.back().append(text).append(" ");
    if (comments.back() == license) comments.back().clear();
  }
  return comments;
}

int occurrences(std::string_view text, std::string_view part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string_view::npos; ++at) ++count;
  return count;
}

OddWords odd_words_in(const std::string& comment) {
  OddWords found;
  for (const std::string start : starts_of_no_sentence) {
    found.starts += comment.starts_with(start);
    for (const char* end : {". ", "! ", "? "}) found.starts += occurrences(comment, end + start);
  }
  for (const char* start : starts_of_no_comment) found.starts += comment.starts_with(start);
  std::string plain = " ";
  for (const char c : comment) {
    const auto letter = static_cast<unsigned char>(c);
    const bool is_name = std::isalnum(letter) || c == '_' || c == '`' || c == '"' || c == '(';
    plain += is_name ? static_cast<char>(std::tolower(letter)) : ' ';
  }
  for (const std::string word : odd_words) found.words += occurrences(plain, " " + word + " ");
  return found;
}

/// Number of lines of the comment at the top of a source, without the license.
int head_lines(std::string_view source) {
  int lines = 0;
  while (source.starts_with("//")) {
    lines += !source.starts_with("// SPDX");
    source.remove_prefix(std::min(source.size(), source.find('\n')));
    if (!source.empty()) source.remove_prefix(1);
  }
  return lines;
}

/// All sources in C++ that have comments of ours.
std::vector<SourceFile> commented_sources() {
  std::vector<SourceFile> found;
  for (const char* top : {"core", "renderer", "include", "tests", "bench", "tools"}) {
    if (!std::filesystem::exists(source_folder() / top)) continue;
    for (const SourceFile& file : files_in(top))
      if (file.name.ends_with(".h") || file.name.ends_with(".cpp") || file.name.ends_with(".inl"))
        found.push_back(file);
  }
  return found;
}

TEST(Comments, odd_words_are_found) {
  const std::string source =
      "// SPDX-License-Identifier: MIT\n// Of a ball. It is\n// round.\n"
      "int a;  ///< what it tells\nf(\"// Who\");\n/* By way of `asks`. */\n/// asked, again\n";
  const std::vector<std::string> comments = comments_of(source);
  EXPECT_EQ(comments, (std::vector<std::string>{"Of a ball. It is round. ", "what it tells ",
                                                "By way of `asks`.  ", "asked, again "}));
  OddWords sum;
  for (const std::string& comment : comments) {
    sum.starts += odd_words_in(comment).starts;
    sum.words += odd_words_in(comment).words;
  }
  EXPECT_EQ(sum, (OddWords{4, 3}));
}

TEST(Comments, have_no_odd_words) {
  std::size_t comments = 0;
  for (const SourceFile& file : commented_sources())
    for (const std::string& comment : comments_of(file.text)) {
      ++comments;
      const OddWords odd = odd_words_in(comment);
      EXPECT_EQ(odd, OddWords{}) << file.name << " has " << odd.starts << " odd starts and "
                                 << odd.words << " odd words, reword: " << comment;
    }
  EXPECT_GT(comments, 10000u);  // the test has found the comments
}

TEST(Comments, at_the_top_of_a_file_have_few_lines) {
  EXPECT_EQ(head_lines("// SPDX-License-Identifier: MIT\n// A ball.\n//\n\n// Round.\n"), 2);
  for (const SourceFile& file : commented_sources())
    EXPECT_LE(head_lines(file.text), most_head_lines)
        << file.name << ": move derivations next to the code or to docs/";
}

}  // namespace
}  // namespace minkray
