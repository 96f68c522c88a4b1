// SPDX-License-Identifier: MIT
// File extensions of outputs with a single format: another extension is likely a mistake.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/base/errors.h"

namespace minkray {

/// Throws WrongUsage unless the file name has this extension. Ignores devices and pipes, which have
/// no extension, and empty names, which the writer reports.
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
