// SPDX-License-Identifier: MIT
#include "renderer/sensor/number_table.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "renderer/json/parse.h"

namespace minkray {
namespace {

/// Limit of mistakes: files with more repeat the same one.
constexpr std::size_t most_mistakes = 20;

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view next_piece(std::string_view& text, char separator) {
  const std::string_view piece = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(piece.size() + 1, text.size()));
  return piece;
}

std::string letters_of(std::string_view title) {
  std::string letters;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

std::optional<std::vector<double>> numbers_between(std::string_view text, char separator) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const bool is_last = rest.find(separator) == rest.npos;
    std::string_view piece = without_blanks(next_piece(rest, separator));
    if (piece.starts_with('+') && !piece.starts_with("+-")) piece.remove_prefix(1);
    double number = 0;
    const char* const end = piece.data() + piece.size();
    const auto [next, error] = std::from_chars(piece.data(), end, number);
    if (error != std::errc() || next != end || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    if (is_last) return numbers;
  }
}

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
  std::string_view rest = *text;
  std::string_view first = next_piece(rest, '\n');
  while (!first.empty()) {
    const std::string_view title = next_piece(first, ',');
    table.titles.push_back(
        {letters_of(title.substr(0, title.find_first_of("/([{"))), letters_of(title)});
  }
  for (std::size_t number = 2; !rest.empty(); ++number) {
    const std::string_view line = without_blanks(next_piece(rest, '\n'));
    if (line.empty()) continue;
    const auto values = numbers_between(line, ',');
    if (values && values->size() == table.width()) {
      table.values.insert(table.values.end(), values->begin(), values->end());
      continue;
    }
    mistakes.add("line " + std::to_string(number) + ": must be " + std::to_string(table.width()) +
                 " numbers between commas");
    if (mistakes.messages().size() >= most_mistakes) break;
  }
  return table;
}

}  // namespace minkray
