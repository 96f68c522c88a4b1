// SPDX-License-Identifier: MIT
#include "renderer/json/parse.h"

#include <gtest/gtest.h>

#include "renderer/json/object_reader.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

std::vector<std::string> complaints(std::string_view text) {
  Mistakes mistakes("x");
  parse_json(text, mistakes);
  return mistakes.messages();
}

TEST(ParseJson, values_come_back_as_they_are_written) {
  const std::string text = R"({"b":[1,-2.5,1e-300,true,null,"\u00e9"],"a":{}})";
  Mistakes mistakes("x");
  const auto json = parse_json(text, mistakes);
  ASSERT_TRUE(json) << mistakes.text();
  EXPECT_EQ(json->dump(), "{\"b\":[1,-2.5,1e-300,true,null,\"\u00e9\"],\"a\":{}}");
}

TEST(ParseJson, numbers_that_are_not_finite_are_told_where_they_stand_and_all_of_them) {
  const std::vector<std::string> expected = {
      "x: /a: must be a finite number (got NaN)",
      "x: /b/0: must be a finite number (got -Infinity)",
      "x: /b/1: must be a finite number (got 1e999)",
      "x: /b/2/c: must be a finite number (got -1e400)",
      "x: /d: must be a finite number (got nan)",
  };
  EXPECT_EQ(complaints(R"({"a": NaN, "b": [-Infinity, 1e999, {"c": -1e400}], "d": nan})"),
            expected);
  // A byte order mark is no word.
  EXPECT_EQ(complaints("\xef\xbb\xbf[1, NaN]"),
            (std::vector<std::string>{"x: /1: must be a finite number (got NaN)"}));
}

TEST(ParseJson, keys_given_twice_are_told_with_their_place) {
  const std::vector<std::string> expected = {"x: /a/0/k: duplicate key"};
  EXPECT_EQ(complaints(R"({"a": [{"k": 1, "l": 2, "k": {"k": 4}}], "k": 3})"), expected);
}

TEST(ParseJson, text_that_is_not_json_is_told_with_its_line_and_column) {
  const auto only = [](std::string_view text) {
    const auto messages = complaints(text);
    EXPECT_EQ(messages.size(), 1u);
    return messages.empty() ? "" : messages[0];
  };
  EXPECT_EQ(
      only("{\n  \"a\": [1,\n  oops]\n}").find("x: /a/1: not valid JSON at line:column 3:3: "), 0u);
  EXPECT_EQ(only("").find("x: /: not valid JSON at line:column 1:1: "), 0u);
  EXPECT_EQ(only("{} {}").find("x: /: not valid JSON at line:column 1:4: "), 0u);
  EXPECT_EQ(only("[1,\n2").find("x: /2: not valid JSON at line:column 2:2: "), 0u);
  EXPECT_EQ(only(std::string_view("{}\n\0", 4)),
            "x: /: not valid JSON at line:column 2:1: a zero byte");
  EXPECT_EQ(only("[1,]").find("x: /1: not valid JSON"), 0u);
  EXPECT_TRUE(has(only("[\"a\xff\"]"), "UTF-8"));
  // Nothing of the broken text reaches the terminal as it is.
  EXPECT_FALSE(has(only("[\"a\xff\"]"), "\xff"));
  EXPECT_FALSE(has(only("[\"\x1b[31m\"]"), "\x1b"));
}

TEST(ParseJson, paths_are_json_pointers) {
  const std::vector<std::string> expected = {"x: /a~1b/~0: must be a finite number (got NaN)"};
  EXPECT_EQ(complaints(R"({"a/b": {"~": NaN}})"), expected);
}

TEST(ParseJson, endless_numbers_that_are_not_finite_end) {
  std::string text = "[NaN";
  for (int i = 0; i < 1000; ++i) text += ", NaN";
  const std::vector<std::string> found = complaints(text + "]");
  ASSERT_EQ(found.size(), 101u);
  EXPECT_EQ(found[0], "x: /0: must be a finite number (got NaN)");
  EXPECT_EQ(found[99], "x: /99: must be a finite number (got NaN)");
  EXPECT_EQ(found[100].find("x: /100: not valid JSON at line:column 1:502: "), 0u) << found[100];
}

TEST(ParseJson, of_very_many_mistakes_the_first_are_told) {
  Mistakes mistakes("x");
  for (int i = 0; i < 10'007; ++i) mistakes.add(JsonPath() / static_cast<std::size_t>(i), "bad");
  mistakes.add("worse");
  EXPECT_EQ(mistakes.messages().size(), 10'000u);
  EXPECT_TRUE(mistakes.text().ends_with("\nx: /9999: bad\nx: and 8 more mistakes"));
}

TEST(ParseJson, of_very_many_names_the_first_are_told) {
  std::vector<std::string> names;
  for (int i = 0; i < 43; ++i) names.push_back("name_" + std::to_string(i));
  const std::string message = suggestion("nothing alike", names);
  EXPECT_TRUE(message.ends_with("name_38, name_39 and 3 more")) << message;
  EXPECT_EQ(suggestion("nmae_42", names), "did you mean \"name_42\"?");
}

/// Characters that end lines or change the order of the letters around them, as "\u202egnp.exe"
/// does.
TEST(ParseJson, messages_show_no_signs_that_steer) {
  for (const char* sign : {"\xE2\x80\xA8", "\xE2\x80\xA9", "\xE2\x80\xAA", "\xE2\x80\xAE",
                           "\xE2\x81\xA6", "\xE2\x81\xA9", "\xC2\x9B", "\x1B", "\x7F", "\n"})
    EXPECT_EQ(printable("a" + std::string(sign) + "b"), "a?b");
  for (const char* sign :
       {"\xE2\x80\xA7", "\xE2\x80\xAF", "\xE2\x81\xA5", "\xE2\x81\xAA", "\xC2\xA0", "\xD9\x85"})
    EXPECT_EQ(printable("a" + std::string(sign) + "b"), "a" + std::string(sign) + "b");
}

TEST(ParseJson, numbers_that_are_not_finite_move_nothing) {
  // Numbers are distinguished from lookalikes in texts, after escaped quotes and between nulls.
  const std::vector<std::string> found = complaints(
      "{\"NaN\": \"NaN, \\\" NaN\",\n \"a\": [null, NaN, 0, \"\\\\\", +Infinity, 1e-999],\n"
      " \"b\": [true, -inf, {\"c\": 1e309, \"c\": nan}], \"d\": NaN, oops}");
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[0], "x: /a/1: must be a finite number (got NaN)");
  EXPECT_EQ(found[1], "x: /a/4: must be a finite number (got +Infinity)");
  EXPECT_EQ(found[2], "x: /b/1: must be a finite number (got -inf)");
  EXPECT_EQ(found[3], "x: /b/2/c: must be a finite number (got 1e309)");
  EXPECT_EQ(found[4], "x: /d: must be a finite number (got NaN)");
  EXPECT_EQ(found[5].find("x: /: not valid JSON at line:column 3:55: "), 0u) << found[5];
}

TEST(ParseJson, mistakes_behind_numbers_that_are_not_finite_keep_their_lines_and_columns) {
  const auto last = [](std::string_view text) { return complaints(text).back(); };
  EXPECT_EQ(last("[NaN, oops]").find("x: /1: not valid JSON at line:column 1:7: "), 0u);
  EXPECT_EQ(last("[-Infinity,\nNaN, NaN, ]").find("x: /3: not valid JSON at line:column 2:11: "),
            0u);
  EXPECT_EQ(last("[1e999,\n inf,\n  NaN nan]").find("x: /3: not valid JSON at line:column 3:"), 0u);
  // A part of a word is no number either.
  for (const std::string text : {"[--NaN]", "[1-NaN]", "[NaNs]", "[nan1]", "[1e999x]", "[1.NaN]"})
    EXPECT_TRUE(has(last(text), "not valid JSON at line:column 1:")) << text;
}

}  // namespace
}  // namespace minkray
