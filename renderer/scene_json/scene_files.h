// SPDX-License-Identifier: MIT
// A scene file with all files that it includes, each read once.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/hash.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Limit of the nesting of includes.
inline constexpr std::size_t deepest_includes = 64;
inline constexpr std::size_t most_included_files = 10'000;

struct SceneFile {
  std::string shown;             ///< name in messages
  std::filesystem::path folder;  ///< relative to the scene's; empty for the scene
  Json json;
  int version = 0;  ///< 0 if it is wrong
  /// The files that it includes, by the JSON of their names.
  std::map<const Json*, const SceneFile*> included;
  std::vector<const SceneFile*> included_by_file;  ///< those of its own "include"
};

class SceneFiles {
 public:
  /// `text` is the scene's, `folder` the folder of its files. An unreadable file is a mistake.
  SceneFiles(std::string_view text, std::filesystem::path folder, Mistakes& mistakes);

  /// Null if it could not be read.
  const SceneFile* main() const { return main_; }
  /// Each after those that it includes; the scene itself is the last one.
  const std::vector<std::unique_ptr<SceneFile>>& all() const { return files_; }
  /// The included ones as files.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// Adds the included files' contents.
  void add_to(Hash& hash) const;

 private:
  struct Link {
    std::filesystem::path file;
    std::string shown;
  };

  const SceneFile* read(std::string_view text, const std::string& shown,
                        const std::filesystem::path& relative_folder);
  void include_all(SceneFile& file);
  void include_in_groups(SceneFile& file, const Json& objects, const JsonPath& path);
  const SceneFile* include(SceneFile& file, const Json& name, const JsonPath& path);

  std::filesystem::path folder_;
  Mistakes& mistakes_;
  std::vector<Link> chain_;  ///< the files that are being read, each included by the one before
  std::map<std::filesystem::path, const SceneFile*> known_;
  std::vector<std::unique_ptr<SceneFile>> files_;
  std::vector<std::filesystem::path> paths_;
  std::size_t bytes_ = 0;
  Hash hash_;
  const SceneFile* main_ = nullptr;
};

}  // namespace minkray
