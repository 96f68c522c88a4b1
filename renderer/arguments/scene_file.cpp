// SPDX-License-Identifier: MIT
#include "renderer/arguments/scene_file.h"

#include <algorithm>
#include <filesystem>

#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/io/png.h"
#include "renderer/json/closest_word.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// Folders relative to the program's own: for an installed program, and for a build in build/PRESET
/// of the sources.
constexpr const char* relative_folders[] = {"../share/minkray/scenes", "../../scenes"};

std::vector<fs::path> scene_folders() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> folders;
  if (error) return folders;
  for (const char* relative : relative_folders) {
    const fs::path folder = (program.parent_path() / relative).lexically_normal();
    if (fs::is_directory(folder, error)) folders.push_back(folder);
  }
  return folders;
}

/// Excludes schemas, which are in the same folder.
bool is_scene(const fs::path& file) {
  return file.extension() == ".json" && !file.stem().string().ends_with(".schema");
}

}  // namespace

std::vector<std::string> built_in_scenes() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path& folder : scene_folders())
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (is_scene(entry.path())) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string scene_file(const std::string& name) {
  std::error_code error;
  const bool is_path = name.find('/') != std::string::npos || fs::path(name).has_extension();
  if (name.empty() || is_path || fs::exists(name, error)) return name;
  for (const fs::path& folder : scene_folders()) {
    const fs::path file = folder / (name + ".json");
    if (fs::exists(file, error)) return file.string();
  }
  const std::vector<std::string> known = built_in_scenes();
  const auto meant = closest_word(name, known);
  throw BadInput(name + ": must be a scene file or one of the scenes that come with Minkray (" +
                 (known.empty() ? "none is here" : listed(known)) + ")" +
                 (meant ? "; did you mean `" + *meant + "`?" : ""));
}

std::string default_output(const std::string& scene_file, const std::string& suffix) {
  const std::string output = fs::path(scene_file).stem().string() + suffix;
  std::error_code error;
  if (fs::exists(output, error) && !is_own_png(output))
    throw WrongUsage("--output: " + output +
                     " exists and was not written by Minkray; choose an output with -o");
  return output;
}

}  // namespace minkray
