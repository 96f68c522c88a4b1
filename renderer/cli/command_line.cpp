// SPDX-License-Identifier: MIT
#include "renderer/cli/command_line.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

namespace minkray {
namespace {

std::string shell_quoted(const std::string& word) {
  const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-+=./:,@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string command_line() {
  std::ifstream arguments("/proc/self/cmdline", std::ios::binary);
  std::string line;
  for (std::string word; std::getline(arguments, word, '\0');) {
    // The program's own name, without the folder of one machine.
    if (line.empty())
      line = shell_quoted(word.substr(word.rfind('/') + 1));
    else
      line += " " + shell_quoted(word);
  }
  return line;
}

}  // namespace minkray
