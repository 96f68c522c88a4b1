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

std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

void run_beside(const std::string& verb, const std::string& program,
                std::vector<std::string> words) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string path = (self.parent_path() / program).string();
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(path.c_str(), pointers.data());
  if (errno == ENOENT)
    throw WrongUsage(verb + ": needs the program " + program + ", which must be in " +
                     self.parent_path().string() +
                     " and is not there: build or install all of Minkray");
  throw WrongUsage(verb + ": " + path + ": " + std::generic_category().message(errno));
}

}  // namespace minkray
