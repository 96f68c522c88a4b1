// SPDX-License-Identifier: MIT
// The files of this repository, for tests of the sources themselves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace minkray {

/// Folder of the sources.
std::filesystem::path source_folder();

struct SourceFile {
  std::string name;  ///< relative to the sources' folder, with forward slashes
  std::string text;
};

/// All files in a folder of the sources, and in its folders, in the order of their names.
std::vector<SourceFile> files_in(const std::string& folder);

std::string text_of_file(const std::filesystem::path& file);

/// Names that the file includes by <...> and by "...", without the brackets.
std::vector<std::string> library_includes(const SourceFile& file);
std::vector<std::string> own_includes(const SourceFile& file);

}  // namespace minkray
