// SPDX-License-Identifier: MIT
#include "renderer/cli/command_files.h"

#include <sys/stat.h>

#include "renderer/base/errors.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

std::string inode_of(const struct stat& status) {
  return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

[[noreturn]] void refuse(const std::string& option, const std::string& file,
                         const std::string& other) {
  throw WrongUsage(option + ": " + printable(file) + " is read or written already, as " +
                   printable(other));
}

}  // namespace

void CommandFiles::read(const fs::path& file) {
  const std::string key = identity(file);
  if (key.empty()) return;
  const auto [known, is_new] = known_.try_emplace(key, Known{file.string(), ""});
  if (!is_new && !known->second.option.empty())
    refuse(known->second.option, known->second.name, file.string());
}

void CommandFiles::read(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) read(file);
}

void CommandFiles::write(const fs::path& file, const std::string& option) {
  const std::string key = identity(file);
  if (key.empty()) return;
  const auto [known, is_new] = known_.try_emplace(key, Known{file.string(), option});
  if (!is_new) refuse(option, file.string(), known->second.name);
}

std::string CommandFiles::identity(const fs::path& file) {
  if (file.empty()) return "";
  struct stat status = {};
  if (::stat(file.c_str(), &status) == 0) return S_ISREG(status.st_mode) ? inode_of(status) : "";
  // A file that does not exist yet: its folder, which may have several names, and its own name.
  const std::string parent = file.parent_path().string();
  const auto [folder, is_new] = folders_.try_emplace(parent);
  if (is_new) {
    std::error_code error;
    folder->second = ::stat(parent.empty() ? "." : parent.c_str(), &status) == 0
                         ? inode_of(status)
                         : fs::weakly_canonical(fs::absolute(parent, error), error).string();
  }
  return folder->second + "/" + file.filename().string();
}

}  // namespace minkray
