// SPDX-License-Identifier: MIT
#include "renderer/json/parse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/files/regular_file.h"
#include "renderer/base/of_file.h"

namespace minkray {
namespace {

/// Number of numbers that are not finite after which parsing stops.
constexpr std::size_t most_not_finite = 100;

/// A number that is not finite (NaN, -Infinity, 1e999).
struct NotFinite {
  std::size_t ordinal = 0;  ///< count of numbers, trues, falses and nulls before it
  std::string written;
};

/// True if a word is another language's spelling of NaN or infinity, or a number that nlohmann-json
/// reads as infinite.
bool is_not_finite(std::string_view word) {
  const bool has_sign = word.starts_with('-') || word.starts_with('+');
  const std::string_view digits = word.substr(has_sign ? 1 : 0);
  const auto is = [&](std::string_view name) {
    return std::equal(digits.begin(), digits.end(), name.begin(), name.end(),
                      [](char a, char b) { return (a | 0x20) == b; });
  };
  if (is("nan") || is("inf") || is("infinity")) return true;

  // Whatever has neither an exponent nor hundreds of digits is not too large.
  constexpr auto digits_of_largest = std::size_t{std::numeric_limits<double>::max_exponent10};
  if (digits.empty() || digits[0] < '0' || digits[0] > '9' || word[0] == '+') return false;
  if (digits.size() <= digits_of_largest && digits.find_first_of("eE") == digits.npos) return false;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // Numbers too near zero are out of range, too, but read as zero.
  return error == std::errc::result_out_of_range && end == digits.data() + digits.size() &&
         std::isinf(std::strtod(std::string(digits).c_str(), nullptr));
}

/// Finds the first numbers of a JSON text that are not finite, and writes 0 and blanks in their
/// place: nlohmann-json stops at them, but nothing else moves. Counts as nlohmann-json does up to
/// the first error in the text.
std::vector<NotFinite> replace_not_finite(std::string& text) {
  constexpr std::string_view between_words = "\"[]{},: \t\r\n";
  std::vector<NotFinite> replaced;
  std::size_t ordinal = 0;
  const std::string_view byte_order_mark = "\xef\xbb\xbf";  // nlohmann-json skips it
  const std::size_t begin = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  for (std::size_t at = begin; at < text.size() && replaced.size() < most_not_finite;) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"';) at += text[at] == '\\' ? 2 : 1;
      ++at;
    } else if (between_words.find(text[at]) != between_words.npos) {
      ++at;
    } else {
      const std::size_t end = std::min(text.find_first_of(between_words, at), text.size());
      const std::string_view word = std::string_view(text).substr(at, end - at);
      if (is_not_finite(word)) {
        replaced.push_back({ordinal, std::string(word)});
        std::fill(text.begin() + std::ptrdiff_t(at), text.begin() + std::ptrdiff_t(end), ' ');
        text[at] = '0';
      }
      ++ordinal;
      at = end;
    }
  }
  return replaced;
}

/// Builds the value while nlohmann-json reads the text, and tracks its path.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(const std::vector<NotFinite>& not_finite, Mistakes& mistakes)
      : not_finite_(not_finite), mistakes_(mistakes) {}

  Json take_root() { return std::move(root_); }

  /// True if each number that is not finite has been reported.
  bool has_reported_all() const { return reported_ == not_finite_.size(); }

  /// Position at which reading stopped, if it did: the bytes before the last one read, and the
  /// reason.
  std::size_t error_position = 0;
  std::string error_reason;
  bool too_deep = false;

  JsonPath path() const {
    JsonPath path;
    for (const Level& level : levels_) {
      if (level.filled.is_array()) {
        path = std::move(path) / level.filled.size();
      } else if (level.has_key) {
        path = std::move(path) / level.key;
      }
    }
    return path;
  }

  bool null() override { return put_word(nullptr); }
  bool boolean(bool value) override { return put_word(value); }
  bool number_integer(number_integer_t value) override { return put_word(value); }
  bool number_unsigned(number_unsigned_t value) override { return put_word(value); }
  bool number_float(number_float_t value, const string_t&) override { return put_word(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Level& level = levels_.back();
    level.key = key;
    level.has_key = true;
    level.is_duplicate = !level.keys.insert(key).second;
    if (level.is_duplicate) mistakes_.add(path(), "duplicate key");
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    error_position = position - 1;  // nlohmann-json has read that byte, or found the end there
    error_reason = error.what();
    return false;
  }

 private:
  struct Level {
    Json filled;  // the list or object so far; moves into its parent when it closes
    std::string key;
    bool has_key = false;
    bool is_duplicate = false;
    std::unordered_set<std::string> keys;
  };

  /// Puts null, and adds a mistake, where a number is not finite.
  bool put_word(Json value) {
    if (reported_ < not_finite_.size() && not_finite_[reported_].ordinal == words_) {
      mistakes_.add(path(), "must be a finite number (got " +
                                printable(not_finite_[reported_].written, 40) + ")");
      value = nullptr;
      ++reported_;
    }
    ++words_;
    return put(std::move(value));
  }

  /// Puts a finished value into the innermost open list or object.
  bool put(Json value) {
    if (levels_.empty()) {
      root_ = std::move(value);
      return true;
    }
    Level& level = levels_.back();
    if (level.filled.is_array()) {
      level.filled.push_back(std::move(value));
    } else {
      if (!level.is_duplicate) {
        level.filled.add_new_member(level.key, std::move(value));
      }
      level.has_key = false;
    }
    return true;
  }

  bool open(Json value) {
    if (levels_.size() == deepest_json_nesting) {
      too_deep = true;
      return false;
    }
    levels_.emplace_back();
    levels_.back().filled = std::move(value);
    return true;
  }

  bool close() {
    Json value = std::move(levels_.back().filled);
    levels_.pop_back();
    return put(std::move(value));
  }

  const std::vector<NotFinite>& not_finite_;
  Mistakes& mistakes_;
  std::size_t words_ = 0;     ///< numbers, trues, falses and nulls so far
  std::size_t reported_ = 0;  ///< of those that are not finite
  Json root_;
  std::vector<Level> levels_;
};

/// "3:17": the line and column of a byte of the text.
std::string line_and_column(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, std::min(position, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  return std::to_string(line) + ':' + std::to_string(before.size() - start + 1);
}

/// nlohmann-json's reason without its own name and its own idea of the place.
std::string reason(const std::string& what) {
  std::size_t start = what.find("syntax error while parsing ");
  if (start == std::string::npos) {
    start = what.find("] ");
    return start == std::string::npos ? what : what.substr(start + 2);
  }
  start = what.find(" - ", start);
  return start == std::string::npos ? what : what.substr(start + 3);
}

}  // namespace

std::optional<Json> parse_json(std::string_view text, Mistakes& mistakes) {
  std::string repaired(text);
  const std::vector<NotFinite> not_finite = replace_not_finite(repaired);
  TreeBuilder tree(not_finite, mistakes);
  if (nlohmann::json::sax_parse(repaired, &tree)) {
    // nlohmann-json takes a zero byte for the end of the text.
    const std::size_t zero = text.find('\0');
    if (zero != text.npos)
      mistakes.add(
          {}, "not valid JSON at line:column " + line_and_column(text, zero) + ": a zero byte");
    else if (!tree.has_reported_all())
      mistakes.add({}, "must hold finite numbers only");
    else
      return tree.take_root();
  } else if (tree.too_deep) {
    mistakes.add(tree.path(), "must not be nested more than " +
                                  std::to_string(deepest_json_nesting) + " levels deep");
  } else {
    const std::string_view rest = text.substr(std::min(tree.error_position, text.size()));
    const bool is_comment =
        rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with('#');
    mistakes.add(tree.path(),
                 "not valid JSON at line:column " + line_and_column(text, tree.error_position) +
                     ": " +
                     (is_comment ? "JSON has no comments (scenes of version 2 have: // to the "
                                   "end of a line): remove it"
                                 : printable(reason(tree.error_reason), 200)));
  }
  return std::nullopt;
}

Uncommented without_comments(std::string_view text) {
  Uncommented made{std::string(text), ""};
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"' && text[at] != '\n';)
        at += text[at] == '\\' ? 2 : 1;
    } else if (text.substr(at, 2) == "//") {
      if (made.first_comment.empty()) made.first_comment = line_and_column(text, at);
      for (; at < text.size() && text[at] != '\n' && text[at] != '\r'; ++at) made.text[at] = ' ';
    }
  }
  return made;
}

Json Json::parse(std::string_view text) {
  Mistakes mistakes("JSON");
  std::optional<Json> json = parse_json(text, mistakes);
  if (!json || !mistakes.none()) throw std::invalid_argument(mistakes.text());
  return std::move(*json);
}

std::optional<std::string> read_text_file(const std::filesystem::path& path, Mistakes& mistakes) {
  try {
    return read_regular_file(path, most_json_bytes);
  } catch (const std::exception& error) {
    mistakes.add(what_of(error));
    return std::nullopt;
  }
}

}  // namespace minkray
