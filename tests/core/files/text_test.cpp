// SPDX-License-Identifier: MIT
// ReadNumbers, words and lines of text: rows of a text and what is read.
#include "core/files/text.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace minkray {
namespace {

using ReadNumbers = std::optional<std::vector<double>>;
using TextList = std::vector<std::string>;

TEST(Text, is_a_number_if_all_of_it_is) {
  const std::pair<std::string_view, std::optional<double>> rows[] = {
      {"0", 0},        {"-5", -5},       {"5.", 5},          {".5", 0.5},   {"1e3", 1000},
      {"1E-3", 0.001}, {"-0.25", -0.25}, {"1e-320", 1e-320}, {"", {}},      {" ", {}},
      {"+5", {}},      {" 5", {}},       {"5 ", {}},         {"5x", {}},    {"1e", {}},
      {"1e+", {}},     {"--5", {}},      {"0x10", {}},       {"1,5", {}},   {"5\n", {}},
      {"nan", {}},     {"inf", {}},      {"-infinity", {}},  {"1e999", {}}, {"1_000", {}}};
  for (const auto& [text, number] : rows) EXPECT_EQ(finite_number(text), number) << text;
}

TEST(Text, is_a_whole_number_only_without_a_point) {
  const std::pair<std::string_view, std::optional<int>> rows[] = {{"2147483647", 2147483647},
                                                                  {"-1", -1},
                                                                  {"007", 7},
                                                                  {"2147483648", {}},
                                                                  {"1.0", {}},
                                                                  {"1e3", {}},
                                                                  {"+1", {}},
                                                                  {"", {}}};
  for (const auto& [text, number] : rows) {
    int read = 0;
    const bool is_read = read_number(text, read);
    EXPECT_EQ(is_read ? std::optional(read) : std::nullopt, number) << text;
  }
  std::uint64_t seed = 0;
  EXPECT_TRUE(read_number("18446744073709551615", seed));
  EXPECT_EQ(seed, ~std::uint64_t{0});
  EXPECT_FALSE(read_number("18446744073709551616", seed));
  EXPECT_FALSE(read_number("-1", seed));
}

/// Files may have blanks around numbers, and one plus sign.
TEST(Text, of_a_number_in_a_file_loses_blanks_and_a_plus_sign) {
  const std::pair<std::string_view, std::optional<double>> rows[] = {
      {"+5", 5},   {" +5\t", 5}, {"5\r", 5},  {" -5 ", -5}, {"++5", {}},
      {"+-5", {}}, {"+", {}},    {"+ 5", {}}, {"", {}},     {"+nan", {}}};
  for (const auto& [text, number] : rows)
    EXPECT_EQ(finite_number(bare_number(text)), number) << text;
}

TEST(Text, between_separators_is_numbers_if_each_piece_is_one) {
  const std::pair<std::string_view, ReadNumbers> rows[] = {
      {"1", {{1}}}, {"1,2", {{1, 2}}}, {"-1,.5,1e2", {{-1, 0.5, 100}}},
      {"", {}},     {",", {}},         {"1,", {}},
      {",1", {}},   {"1,,2", {}},      {"1, 2", {}},
      {"1,+2", {}}, {"1,nan", {}},     {"1,1e999", {}},
      {"1;2", {}}};
  for (const auto& [text, numbers] : rows) EXPECT_EQ(numbers_between(text, ','), numbers) << text;
  EXPECT_EQ(numbers_between("1 , +2", ',', bare_number), ReadNumbers({1, 2}));
  EXPECT_EQ(numbers_between("1,2,", ',', bare_number), std::nullopt);
  EXPECT_EQ(numbers_between<int>("640x480", 'x'), std::optional(std::vector<int>{640, 480}));
  for (const std::string_view wrong : {"640x480x", "x480", "640.0x480", "640x+480", "640x 480"})
    EXPECT_EQ(numbers_between<int>(wrong, 'x'), std::nullopt) << wrong;
}

TEST(Text, has_one_piece_more_than_separators) {
  const std::pair<std::string_view, TextList> rows[] = {
      {"", {""}}, {"a", {"a"}}, {"a,b", {"a", "b"}}, {",a,", {"", "a", ""}}, {",,", {"", "", ""}}};
  for (const auto& [text, pieces] : rows) EXPECT_EQ(pieces_of(text, ','), pieces) << text;
}

TEST(Text, has_lines_by_the_ends_of_all_systems) {
  const auto lines_of = [](std::string_view text) {
    TextList lines;
    while (!text.empty()) lines.emplace_back(next_line(text));
    return lines;
  };
  const std::pair<std::string_view, TextList> rows[] = {{"", {}},
                                                        {"a", {"a"}},
                                                        {"a\n", {"a"}},
                                                        {"a\nb", {"a", "b"}},
                                                        {"a\r\nb\r\n", {"a", "b"}},
                                                        {"a\rb", {"a", "b"}},
                                                        {"a\n\nb", {"a", "", "b"}},
                                                        {"\r\n\r\n", {"", ""}}};
  for (const auto& [text, lines] : rows) EXPECT_EQ(lines_of(text), lines) << text;
}

TEST(Text, has_words_between_blanks) {
  const auto words_of = [](std::string_view text) {
    TextList words;
    for (std::string_view word; !(word = next_word(text)).empty();) words.emplace_back(word);
    return words;
  };
  EXPECT_EQ(words_of(""), TextList());
  EXPECT_EQ(words_of(" \t\r\n"), TextList());
  EXPECT_EQ(words_of("v 1\t2  3\r\n"), TextList({"v", "1", "2", "3"}));
  EXPECT_EQ(without_blanks(" \ta b\r\n"), "a b");
  EXPECT_EQ(without_byte_order_mark("\xef\xbb\xbfv 1"), "v 1");
  EXPECT_EQ(without_byte_order_mark("v\xef\xbb\xbf"), "v\xef\xbb\xbf");
}

TEST(Text, of_a_list_has_separators_between_its_items) {
  const TextList names = {"path", "direct", "ambient"};
  EXPECT_EQ(listed(names), "path, direct, ambient");
  EXPECT_EQ(listed(
                names, [](const std::string& name) { return name.substr(0, 1); }, "|"),
            "p|d|a");
  EXPECT_EQ(listed(TextList()), "");
  EXPECT_EQ(listed(TextList{"one"}), "one");
}

}  // namespace
}  // namespace minkray
