// SPDX-License-Identifier: MIT
// Outputs of one format only: a name with another ending is likely another file's.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/base/errors.h"

namespace minkray {

/// Throws WrongUsage unless the file's name ends so. Devices and pipes have no endings, and that a
/// name is empty is told by whoever writes.
inline void check_ending(const std::string& file, const std::string& ending,
                         const std::string& option) {
  if (file.empty()) return;
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status)) return;
  if (std::filesystem::path(file).extension() != ending)
    throw WrongUsage(option + ": must end in " + ending + " (got " + file + ")");
}

}  // namespace minkray
