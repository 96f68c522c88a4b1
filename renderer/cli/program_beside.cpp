// SPDX-License-Identifier: MIT
#include "renderer/cli/program_beside.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "renderer/base/errors.h"

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

void run_beside(const std::string& verb, const std::string& program) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string path = (self.parent_path() / program).string();
  std::vector<std::string> arguments = words();
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv(path.c_str(), pointers.data());
  if (errno == ENOENT)
    throw WrongUsage(verb + ": needs the program " + program + " beside this one, which ./run " +
                     verb + " builds");
  throw WrongUsage(verb + ": " + path + ": " + std::generic_category().message(errno));
}

}  // namespace minkray
