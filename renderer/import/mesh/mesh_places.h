// SPDX-License-Identifier: MIT
// Finds the files that names in robots' files refer to: paths, and package://, model:// or file://.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/import/model/import_options.h"

namespace minkray {

/// The places between commas; of many, the first ones.
std::string list_of_places(const std::vector<std::filesystem::path>& places);

class MeshPlaces {
 public:
  /// `folder`: that of the file that names the meshes.
  MeshPlaces(std::filesystem::path folder, const ImportOptions& options)
      : folder_(std::move(folder)), options_(&options) {}

  /// The file that a name refers to, if there is one; `looked_for` gets all places.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            std::vector<std::filesystem::path>& looked_for) const;
  /// Searches other folders as well.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::vector<std::filesystem::path>& also_in,
                                            std::vector<std::filesystem::path>& looked_for) const;

 private:
  std::vector<std::filesystem::path> folders_of_package(
      const std::string& package, const std::vector<std::filesystem::path>& folders) const;

  std::filesystem::path folder_;
  const ImportOptions* options_;
  mutable std::map<std::string, std::vector<std::filesystem::path>> packages_;  ///< folders
};

}  // namespace minkray
