// SPDX-License-Identifier: MIT
// CSV files of numbers with titles, such as recordings and Livox's patterns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/json/mistakes.h"

namespace minkray {

struct NumberTable {
  /// Letters and digits of a title in lower case: "Time/s" has the name "time", the letters
  /// "times".
  struct Title {
    std::string name;  ///< part before the unit, which a slash or a bracket begins
    std::string letters;
  };
  std::string file;
  std::vector<Title> titles;
  std::vector<double> values;  ///< row by row

  std::size_t width() const { return titles.size(); }
  std::size_t rows() const { return titles.empty() ? 0 : values.size() / titles.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * width() + column]; }
  /// Returns the column of that name, or else the one whose title begins with the name. Throws
  /// BadInput if several titles match: with "x_std" and "x_mean", neither is x.
  std::optional<std::size_t> column(std::string_view name) const;
};

/// Reads titles from the first line, and as many finite numbers from each other line. Blank lines
/// are skipped. Mistakes have their line.
NumberTable read_number_table(const std::string& file, Mistakes& mistakes);

}  // namespace minkray
