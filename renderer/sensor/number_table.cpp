// SPDX-License-Identifier: MIT
#include "renderer/sensor/number_table.h"

#include "renderer/base/csv.h"
#include "renderer/json/parse.h"

namespace minkray {
namespace {

/// Limit of mistakes: files with more repeat the same one.
constexpr std::size_t most_mistakes = 20;

}  // namespace

std::optional<std::size_t> NumberTable::column(std::string_view name) const {
  const auto among = [&](auto&& fits) {
    std::optional<std::size_t> found;
    for (std::size_t c = 0; c < titles.size(); ++c) {
      if (!fits(titles[c])) continue;
      if (found)
        throw BadInput(printable(file, 200) + ": line 1: must name one column " +
                       std::string(name) + " (got " + std::to_string(*found + 1) + " and " +
                       std::to_string(c + 1) + ", \"" + printable(titles[*found].letters, 40) +
                       "\" and \"" + printable(titles[c].letters, 40) + "\")");
      found = c;
    }
    return found;
  };
  if (const auto named = among([&](const Title& title) { return title.name == name; }))
    return named;
  return among([&](const Title& title) { return title.letters.starts_with(name); });
}

NumberTable read_number_table(const std::string& file, Mistakes& mistakes) {
  NumberTable table;
  table.file = file;
  const auto text = read_text_file(file, mistakes);
  if (!text) return table;
  CsvLines lines(*text);
  for (const std::string_view title : lines.cells())
    table.titles.push_back(
        {letters_of(title.substr(0, title.find_first_of("/([{"))), letters_of(title)});
  while (mistakes.messages().size() < most_mistakes && lines.next()) {
    const std::size_t begin = table.values.size();
    for (const std::string_view cell : lines.cells())
      if (const auto number = finite_number(bare_number(cell))) table.values.push_back(*number);
    if (lines.cells().size() == table.width() && table.values.size() == begin + table.width())
      continue;
    mistakes.add("line " + std::to_string(lines.number()) + ": must be " +
                 std::to_string(table.width()) + " numbers between commas");
  }
  return table;
}

}  // namespace minkray
