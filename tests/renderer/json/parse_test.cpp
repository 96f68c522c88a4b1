// SPDX-License-Identifier: MIT
#include "renderer/json/parse.h"

#include <gtest/gtest.h>

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
}

TEST(ParseJson, keys_given_twice_are_told_with_their_place) {
  const std::vector<std::string> expected = {"x: /a/0/k: key given twice"};
  EXPECT_EQ(complaints(R"({"a": [{"k": 1, "l": 2, "k": {"k": 4}}], "k": 3})"), expected);
}

TEST(ParseJson, text_that_is_not_json_is_told_with_its_line_and_column) {
  const auto only = [](std::string_view text) {
    const auto messages = complaints(text);
    EXPECT_EQ(messages.size(), 1u);
    return messages.empty() ? "" : messages[0];
  };
  EXPECT_EQ(only("{\n  \"a\": [1,\n  oops]\n}").find("x: /a/1: not valid JSON at line:column 3:"),
            0u);
  EXPECT_EQ(only("").find("x: /: not valid JSON at line:column 1:1: "), 0u);
  EXPECT_EQ(only("{} {}").find("x: /: not valid JSON at line:column 1:"), 0u);
  EXPECT_EQ(only(std::string_view("{}\n\0", 4)),
            "x: /: not valid JSON at line:column 2:1: a zero byte");
  EXPECT_EQ(only("[1,]").find("x: /1: not valid JSON"), 0u);
  EXPECT_NE(only("[\"a\xff\"]").find("UTF-8"), std::string::npos);
  // Nothing of the broken text reaches the terminal as it is.
  EXPECT_EQ(only("[\"a\xff\"]").find('\xff'), std::string::npos);
  EXPECT_EQ(only("[\"\x1b[31m\"]").find('\x1b'), std::string::npos);
}

TEST(ParseJson, paths_are_json_pointers) {
  const std::vector<std::string> expected = {"x: /a~1b/~0: must be a finite number (got NaN)"};
  EXPECT_EQ(complaints(R"({"a/b": {"~": NaN}})"), expected);
}

TEST(ParseJson, endless_numbers_that_are_not_finite_end) {
  std::string text = "[NaN";
  for (int i = 0; i < 1000; ++i) text += ", NaN";
  EXPECT_LT(complaints(text + "]").size(), 200u);
}

}  // namespace
}  // namespace minkray
