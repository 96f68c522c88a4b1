// SPDX-License-Identifier: MIT
#include "renderer/cli/command_line.h"

#include <fstream>

#include "renderer/cli/shell_quoted.h"

namespace minkray {

std::string command_line() {
  std::ifstream arguments("/proc/self/cmdline", std::ios::binary);
  std::string line;
  for (std::string word; std::getline(arguments, word, '\0');) {
    // Removes the folder from the program's name, since machines differ in it.
    if (line.empty())
      line = shell_quoted(word.substr(word.rfind('/') + 1));
    else
      line += " " + shell_quoted(word);
  }
  return line;
}

}  // namespace minkray
