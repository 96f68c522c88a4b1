// SPDX-License-Identifier: MIT
// Collects the user's errors in one file, to report all of them together.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "renderer/base/errors.h"
#include "renderer/json/path.h"

namespace minkray {

class Mistakes {
 public:
  /// `file` is the name that the messages begin with: "scenes/x.json", "cases.jsonl:12".
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  /// One mistake at a place in the document: what was expected and what was found. Only the first
  /// one at each place is kept: its consequences would be noise. The first 10,000 are kept, and
  /// the others counted.
  void add(const JsonPath& path, std::string_view message);

  /// One mistake of the file as a whole.
  void add(std::string_view message);

  /// Gives the messages to come the name of another file, as that of an include; returns the name
  /// before.
  std::string set_file(std::string file);

  bool none() const { return messages_.empty(); }
  const std::vector<std::string>& messages() const { return messages_; }
  const std::string& file() const { return file_; }

  /// All messages, one per line, without a newline at the end; each as printable() has it.
  std::string text() const;

 private:
  std::string file_;
  std::vector<std::string> messages_;
  std::size_t more_ = 0;  ///< that are not kept
  std::unordered_set<std::string> paths_;
};

/// Names another file in all messages of a block.
class MistakesIn {
 public:
  MistakesIn(Mistakes& mistakes, std::string file)
      : mistakes_(mistakes), before_(mistakes.set_file(std::move(file))) {}
  ~MistakesIn() { mistakes_.set_file(std::move(before_)); }
  MistakesIn(const MistakesIn&) = delete;
  MistakesIn& operator=(const MistakesIn&) = delete;

 private:
  Mistakes& mistakes_;
  std::string before_;
};

/// Throws BadInput with all of the messages, if there are any.
void throw_if_any(const Mistakes& mistakes);

/// The text as it may be shown on a terminal: control characters and broken UTF-8 become '?',
/// and the middle of a text of more than `limit` bytes becomes "...".
std::string printable(std::string_view text,
                      std::size_t limit = std::numeric_limits<std::size_t>::max());

/// Lets the ends of lines stay, in a text of several.
std::string printable_lines(std::string_view text);

}  // namespace minkray
