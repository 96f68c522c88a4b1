// SPDX-License-Identifier: MIT
// Cells of CSV files: rows of a text, its lines' numbers and cells.
#include "renderer/base/csv.h"

#include <gtest/gtest.h>

namespace minkray {
namespace {

/// "1: a|b", "3: c|d": numbers of lines with their cells.
std::vector<std::string> lines_of(std::string_view text,
                                  LastComma last_comma = LastComma::begins_cell) {
  CsvLines lines(text, last_comma);
  std::vector<std::string> found;
  do {
    found.push_back(std::to_string(lines.number()) + ": " + listed(lines.cells(), {}, "|"));
  } while (lines.next());
  return found;
}

using LineList = std::vector<std::string>;

TEST(Csv, has_cells_without_the_blanks_and_quotes_around_them) {
  const std::pair<std::string_view, LineList> rows[] = {
      {"", {"1: "}},
      {"a", {"1: a"}},
      {"a,b\n1,2\n", {"1: a|b", "2: 1|2"}},
      {"a,b\r\n1,2\r\n", {"1: a|b", "2: 1|2"}},
      {"\xef\xbb\xbf"
       "a,b\n1,2",
       {"1: a|b", "2: 1|2"}},
      {" a , \"b c\" \n\t1, 2 ", {"1: a|b c", "2: 1|2"}},
      {"a\n\n \t\n2\n\r\n3\n\n", {"1: a", "4: 2", "6: 3"}}};
  for (const auto& [text, lines] : rows) {
    EXPECT_EQ(lines_of(text), lines) << text;
    EXPECT_EQ(lines_of(text, LastComma::ends_line), lines) << text;
  }
}

TEST(Csv, has_an_empty_cell_behind_a_last_comma_unless_that_ends_the_line) {
  const auto sizes_of = [](std::string_view text, LastComma last_comma) {
    CsvLines lines(text, last_comma);
    std::vector<std::size_t> sizes;
    do {
      sizes.push_back(lines.cells().size());
    } while (lines.next());
    return sizes;
  };
  struct Row {
    std::string_view text;
    std::vector<std::size_t> as_cell, as_end;
  };
  for (const Row& row : {Row{"a,b\n1,2,\n", {2, 3}, {2, 2}}, Row{"a,b,\n1,2,\n", {2, 3}, {2, 2}},
                         Row{"a,b,\n1,2\n", {2, 2}, {2, 2}}, Row{"a,b\n,2\n", {2, 2}, {2, 2}},
                         Row{"a,b\n1,,\n", {2, 3}, {2, 2}}, Row{"a,b\n1,\n", {2, 2}, {2, 1}},
                         Row{"a,b\n,\n1,2\n", {2, 2, 2}, {2, 2}}, Row{"\n1\n", {0, 1}, {0, 1}}}) {
    EXPECT_EQ(sizes_of(row.text, LastComma::begins_cell), row.as_cell) << row.text;
    EXPECT_EQ(sizes_of(row.text, LastComma::ends_line), row.as_end) << row.text;
  }
}

TEST(Csv, of_names_is_read_as_it_was_written) {
  for (const std::string name : {"arm", "left arm", ""}) EXPECT_EQ(csv_cell(name), name);
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"a\""), "\"say \"\"a\"\"\"");
  EXPECT_EQ(csv_cell("a\nb"), "\"a\nb\"");
}

}  // namespace
}  // namespace minkray
