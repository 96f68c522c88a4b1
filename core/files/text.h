// SPDX-License-Identifier: MIT
// Lines, words, pieces and numbers of text; texts joined to a list.
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace minkray {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Removes the byte order mark that some editors on Windows write at the beginning.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

/// Removes the blanks at both ends.
inline std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The letters and digits of a name, in lower case: names by other spellings compare equal.
inline std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c))) letters += c;
  return lower_case(std::move(letters));
}

/// Removes the next line from the front of the text and returns it. Lines end with \n, \r\n, or (on
/// old Macs) \r.
inline std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(std::min<std::size_t>(text.starts_with("\r\n") ? 2 : 1, text.size()));
  return line;
}

/// Removes the next word from the front of the text and returns it. Returns an empty text at the
/// end.
inline std::string_view next_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// Removes the text up to the next separator, and that, from the front and returns the text.
inline std::string_view next_piece(std::string_view& text, char separator) {
  const std::string_view piece = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(piece.size() + 1, text.size()));
  return piece;
}

/// Calls visit(piece) for each text between separators; for the complete text if it has none.
template <class Visit>
void for_each_piece(std::string_view text, char separator, Visit&& visit) {
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
    visit(text.substr(0, end));
  visit(text);
}

inline std::vector<std::string> pieces_of(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  for_each_piece(text, separator, [&](std::string_view piece) { pieces.emplace_back(piece); });
  return pieces;
}

/// Removes the blanks around a number and its plus sign, which files may have.
inline std::string_view bare_number(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  return text;
}

/// Reads and removes a number, without a plus sign, at the beginning of a text. Returns false if
/// the text does not begin with a number. `base` is the base of a whole number, if not 10.
template <class Number, class... Base>
bool take_number(std::string_view& text, Number& number, Base... base) {
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number, base...);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return true;
}

/// True if the complete text is a number, as for take_number.
template <class Number, class... Base>
bool read_number(std::string_view text, Number& number, Base... base) {
  return take_number(text, number, base...) && text.empty();
}

/// Nothing if the text is no number, or not a finite one.
inline std::optional<double> finite_number(std::string_view text) {
  double number = 0;
  if (!read_number(text, number) || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Reads finite numbers between separators; nothing if any piece is something else. `cleaned`
/// removes what a piece may have around its number: bare_number, or nothing.
template <class Number = double, class Cleaned = std::identity>
std::optional<std::vector<Number>> numbers_between(std::string_view text, char separator,
                                                   const Cleaned& cleaned = {}) {
  std::vector<Number> numbers;
  bool are_numbers = true;
  for_each_piece(text, separator, [&](std::string_view piece) {
    Number number{};
    are_numbers = are_numbers && read_number(cleaned(piece), number) &&
                  std::isfinite(static_cast<double>(number));
    if (are_numbers) numbers.push_back(number);
  });
  if (!are_numbers) return std::nullopt;
  return numbers;
}

/// Joins texts: "path, direct, ambient". `text_of` turns an element into its text.
template <class Range, class TextOf = std::identity>
std::string listed(const Range& all, TextOf&& text_of = {}, std::string_view separator = ", ") {
  std::string text;
  for (const auto& one : all) {
    if (!text.empty()) text += separator;
    text += std::invoke(text_of, one);
  }
  return text;
}

}  // namespace minkray
