// SPDX-License-Identifier: MIT
#include "renderer/json/mistakes.h"

#include <utility>

namespace minkray {
namespace {

/// Longer paths have their middle left out.
constexpr std::size_t longest_path = 160;

/// Limit of stored messages, since each may be a kilobyte.
constexpr std::size_t most_messages = 10'000;

/// The number of bytes of the UTF-8 character that starts at text[i], 0 if none does.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF5   ? 0
                             : first >= 0xF0 ? 4
                             : first >= 0xE0 ? 3
                             : first >= 0xC2 ? 2
                                             : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = i + 1; k < i + length; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// True if the character breaks lines or changes the direction of text: U+2028 to U+202E and U+2066
/// to U+2069.
bool turns_text(std::string_view character) {
  return (character >= "\xE2\x80\xA8" && character <= "\xE2\x80\xAE") ||
         (character >= "\xE2\x81\xA6" && character <= "\xE2\x81\xA9");
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are control characters, too.
    const bool is_control =
        first < 0x20 || first == 0x7F ||
        (length == 2 && first == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0) ||
        (length == 3 && turns_text(text.substr(i, 3)));
    if (length == 0 || is_control) {
      shown += '?';
    } else {
      shown += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  if (shown.size() <= limit) return shown;
  std::size_t head = limit / 2;
  std::size_t tail = shown.size() - limit / 2;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(shown[i]) & 0xC0) == 0x80;
  };
  while (head > 0 && continues(head)) --head;
  while (tail < shown.size() && continues(tail)) ++tail;
  return shown.substr(0, head) + "..." + shown.substr(tail);
}

std::string printable_lines(std::string_view text) {
  std::string shown;
  for (;;) {
    const std::size_t end = text.find('\n');
    shown += printable(text.substr(0, end));
    if (end == text.npos) return shown;
    shown += '\n';
    text.remove_prefix(end + 1);
  }
}

void Mistakes::add(const JsonPath& path, std::string_view message) {
  if (messages_.size() >= most_messages) {
    ++more_;
    return;
  }
  if (!paths_.insert(file_ + '\0' + path.text()).second) return;
  add(printable(path.text(), longest_path) + ": " + std::string(message));
}

void Mistakes::add(std::string_view message) {
  if (messages_.size() >= most_messages) {
    ++more_;
    return;
  }
  // The file's name comes from its author, and may hold anything.
  messages_.push_back(printable(file_ + ": " + std::string(message)));
}

std::string Mistakes::set_file(std::string file) {
  return std::exchange(file_, std::move(file));
}

std::string Mistakes::text() const {
  std::string text;
  for (const std::string& message : messages_) {
    if (!text.empty()) text += '\n';
    text += message;
  }
  if (more_ > 0)
    text += '\n' + printable(file_) + ": and " + std::to_string(more_) + " more mistakes";
  return text;
}

void throw_if_any(const Mistakes& mistakes) {
  if (!mistakes.none()) throw BadInput(mistakes.text());
}

}  // namespace minkray
