// SPDX-License-Identifier: MIT
// The robots' models that scenes/fetch-models fetches from Debian.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/source_files.h"

namespace minkray {

inline std::filesystem::path robot_models() {
  return source_folder() / "scenes/meshes/models";
}

inline bool has_robot_models() {
  return std::filesystem::exists(robot_models() / ".complete");
}

/// All files with that ending in a folder of the models, sorted.
inline std::vector<std::string> robot_files(const std::string& folder, const std::string& ending) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(robot_models() / folder))
    if (entry.path().extension() == ending) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

}  // namespace minkray
