// SPDX-License-Identifier: MIT
// CSV files of numbers under titles, as recorders and Livox's patterns write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/json/mistakes.h"

namespace minkray {

struct NumberTable {
  /// The letters and digits of a title, small: "Time/s" has the name "time", the letters "times".
  struct Title {
    std::string name;  ///< what stands before a unit, which a slash or a bracket begins
    std::string letters;
  };
  std::string file;
  std::vector<Title> titles;
  std::vector<double> values;  ///< row by row

  std::size_t width() const { return titles.size(); }
  std::size_t rows() const { return titles.empty() ? 0 : values.size() / titles.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * width() + column]; }
  /// The column of that name; if there is none, that whose title begins so. Throws BadInput if
  /// there are several: of "x_std" and "x_mean" none is x.
  std::optional<std::size_t> column(std::string_view name) const;
};

/// Titles in the first line, as many finite numbers in each of the others; blank lines are passed
/// over. What is wrong is a mistake with its line.
NumberTable read_number_table(const std::string& file, Mistakes& mistakes);

/// All of the finite numbers between the separators; nothing if the text is otherwise.
std::optional<std::vector<double>> numbers_between(std::string_view text, char separator);

}  // namespace minkray
