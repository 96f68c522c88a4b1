// SPDX-License-Identifier: MIT
#include "renderer/json/parse.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/files/regular_file.h"

namespace minkray {
namespace {

/// After so many numbers that are not finite the rest of the text is not read.
constexpr int most_replacements = 100;

/// Builds the value while nlohmann-json reads the text, and knows the path it is at.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  explicit TreeBuilder(Mistakes& mistakes) : mistakes_(mistakes) {}

  Json take_root() { return std::move(root_); }

  /// Where reading stopped, if it did: bytes from the start, the offending text, the reason.
  std::size_t error_position = 0;
  std::string error_token;
  std::string error_reason;
  bool too_deep = false;

  JsonPath path() const {
    JsonPath path;
    for (const Level& level : levels_) {
      if (level.filled.is_array()) {
        path = path / level.filled.size();
      } else if (level.has_key) {
        path = path / level.key;
      }
    }
    return path;
  }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
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
    if (level.is_duplicate) mistakes_.add(path(), "key given twice");
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last_token,
                   const Json::exception& error) override {
    error_position = position;
    error_token = last_token;
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
        level.filled.get_ptr<Json::object_t*>()->push_back({level.key, std::move(value)});
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

  Mistakes& mistakes_;
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

/// Where reading stopped at a number that is not finite (NaN, Infinity, 1e999): its first byte and
/// its length; length 0 if it stopped for another reason.
struct Span {
  std::size_t start = 0;
  std::size_t length = 0;
};
Span number_not_finite(std::string_view text, const TreeBuilder& tree) {
  // A number too large for a double: the reader has just passed it.
  const std::string& token = tree.error_token;
  for (const std::size_t end : {tree.error_position, tree.error_position - 1}) {
    if (token.size() <= end && end <= text.size() && !token.empty() &&
        (token[0] == '-' || (token[0] >= '0' && token[0] <= '9')) &&
        text.substr(end - token.size(), token.size()) == token &&
        tree.error_reason.find("out_of_range") != std::string::npos) {
      return {end - token.size(), token.size()};
    }
  }
  // A word: the reader stopped somewhere in it.
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  std::size_t start = std::min(tree.error_position, text.size());
  while (start > 0 && (is_letter(text[start - 1]) || text[start - 1] == '-')) --start;
  std::size_t end = start;
  if (end < text.size() && text[end] == '-') ++end;
  while (end < text.size() && is_letter(text[end])) ++end;
  std::string word(text.substr(start, end - start));
  if (word.starts_with('-')) word.erase(0, 1);
  for (char& c : word) c = static_cast<char>(c | 0x20);
  if (word == "nan" || word == "inf" || word == "infinity") return {start, end - start};
  return {};
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
  for (int replacements = 0;; ++replacements) {
    TreeBuilder tree(mistakes);
    if (Json::sax_parse(repaired, &tree)) {
      // nlohmann-json takes a zero byte for the end of the text.
      const std::size_t zero = repaired.find('\0');
      if (zero == std::string::npos) return tree.take_root();
      mistakes.add(
          {}, "not valid JSON at line:column " + line_and_column(repaired, zero) + ": a zero byte");
      return std::nullopt;
    }

    if (tree.too_deep) {
      mistakes.add(tree.path(), "must not be nested more than " +
                                    std::to_string(deepest_json_nesting) + " levels deep");
      return std::nullopt;
    }
    const Span span = number_not_finite(repaired, tree);
    if (span.length > 0 && replacements < most_replacements) {
      mistakes.add(tree.path(), "must be a finite number (got " +
                                    printable(repaired.substr(span.start, span.length), 40) + ")");
      repaired.replace(span.start, span.length, "null");
      continue;
    }
    mistakes.add(tree.path(), "not valid JSON at line:column " +
                                  line_and_column(repaired, tree.error_position) + ": " +
                                  printable(reason(tree.error_reason), 200));
    return std::nullopt;
  }
}

std::optional<std::string> read_text_file(const std::filesystem::path& path, Mistakes& mistakes) {
  try {
    return read_regular_file(path, most_json_bytes);
  } catch (const std::runtime_error& error) {
    mistakes.add(error.what());
    return std::nullopt;
  }
}

}  // namespace minkray
