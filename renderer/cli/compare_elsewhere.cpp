// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "renderer/base/errors.h"
#include "renderer/cli/compare_options.h"

namespace minkray {
namespace {

/// The words of this process's command line.
std::vector<std::string> words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

void compare(const CompareArguments&, ExitCode&) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = (self.parent_path() / "minkray-compare").string();
  std::vector<std::string> arguments = words();
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  if (errno == ENOENT)
    throw WrongUsage(
        "compare: needs the program minkray-compare beside this one, which is built "
        "where Embree is installed (./run compare does both)");
  throw WrongUsage("compare: " + program + ": " + std::generic_category().message(errno));
}

}  // namespace minkray
