// SPDX-License-Identifier: MIT
// CSV files: titles in the first line, then as many cells in each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/files/text.h"

namespace minkray {

/// Meaning of a comma at the end of a line of values. A line of titles may always end in one.
enum class LastComma {
  begins_cell,  ///< an empty cell follows
  ends_line,
};

/// Goes through the lines of a text, which must stay alive. Blank lines are skipped. Cells lose the
/// blanks and quotes around them.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text, LastComma last_comma = LastComma::begins_cell)
      : rest_(without_byte_order_mark(text)), last_comma_(last_comma) {
    split(LastComma::ends_line);
  }

  /// Cells of the current line: at first, the titles.
  const std::vector<std::string_view>& cells() const { return cells_; }
  /// Number of the current line, from 1.
  std::size_t number() const { return number_; }

  /// Goes to the next line. Returns false at the end of the text.
  bool next() {
    while (!rest_.empty()) {
      ++number_;
      split(last_comma_);
      if (cells_.size() > 1 || (cells_.size() == 1 && !cells_[0].empty())) return true;
    }
    return false;
  }

 private:
  void split(LastComma last_comma) {
    std::string_view line = without_blanks(next_piece(rest_, '\n'));
    cells_.clear();
    if (last_comma == LastComma::ends_line && line.ends_with(',')) line.remove_suffix(1);
    if (line.empty()) return;
    for_each_piece(line, ',', [&](std::string_view cell) {
      cell = without_blanks(cell);
      while (cell.starts_with('"')) cell.remove_prefix(1);
      while (cell.ends_with('"')) cell.remove_suffix(1);
      cells_.push_back(without_blanks(cell));
    });
  }

  std::string_view rest_;
  LastComma last_comma_;
  std::vector<std::string_view> cells_;
  std::size_t number_ = 1;
};

/// Quotes a name that contains a comma or a quote.
inline std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace minkray
