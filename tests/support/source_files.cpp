// SPDX-License-Identifier: MIT
#include "tests/support/source_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace minkray {
namespace {

std::vector<std::string> includes(const SourceFile& file, char open, char close) {
  std::vector<std::string> found;
  std::istringstream lines(file.text);
  const std::string start = std::string("#include ") + open;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(start)) continue;
    found.push_back(line.substr(start.size(), line.find(close, start.size()) - start.size()));
  }
  return found;
}

}  // namespace

std::filesystem::path source_folder() {
  return MINKRAY_SOURCE_FOLDER;
}

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::vector<SourceFile> files_in(const std::string& folder) {
  std::vector<SourceFile> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_folder() / folder)) {
    if (!entry.is_regular_file()) continue;
    const auto name = std::filesystem::relative(entry.path(), source_folder());
    files.push_back({name.generic_string(), text_of_file(entry.path())});
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.name < b.name; });
  return files;
}

std::vector<std::string> library_includes(const SourceFile& file) {
  return includes(file, '<', '>');
}

std::vector<std::string> own_includes(const SourceFile& file) {
  return includes(file, '"', '"');
}

}  // namespace minkray
