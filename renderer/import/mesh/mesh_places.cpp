// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/mesh_places.h"

#include <algorithm>
#include <string_view>

#include "core/files/text.h"
#include "renderer/import/model/xml.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Largest number of folders to search; a folder has few packages.
constexpr std::size_t most_folders_looked_at = 1000;

/// Returns the name in a folder's package.xml, or nothing.
std::string package_name(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path file = folder / "package.xml";
  if (!std::filesystem::is_regular_file(file, error)) return "";
  Mistakes ignored("");
  XmlFiles files(ignored);
  const auto root = files.read(file);
  const XmlElement* name = root && root->name == "package" ? root->child("name") : nullptr;
  return name ? std::string(without_blanks(name->text)) : "";
}

}  // namespace

/// Those of the folders, and of the folders in them, whose package.xml gives the name.
std::vector<std::filesystem::path> MeshPlaces::folders_of_package(
    const std::string& package, const std::vector<std::filesystem::path>& folders) const {
  const auto known = packages_.find(package);
  if (known != packages_.end()) return known->second;
  std::vector<std::filesystem::path> found;
  for (const std::filesystem::path& folder : folders) {
    if (package_name(folder) == package) found.push_back(folder);
    std::error_code error;
    std::size_t count = 0;
    for (std::filesystem::directory_iterator at(folder, error), end;
         !error && at != end && count < most_folders_looked_at; at.increment(error), ++count)
      if (std::error_code ignored; at->is_directory(ignored) && package_name(at->path()) == package)
        found.push_back(at->path());
  }
  return packages_[package] = found;
}

std::string list_of_places(const std::vector<std::filesystem::path>& places) {
  constexpr std::size_t longest = 360;
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string place = printable(places[i].string(), 160);
    if (text.size() + place.size() > longest)
      return text + " and " + std::to_string(places.size() - i) + " more places";
    text += (i > 0 ? ", " : "") + place;
  }
  return text;
}

std::optional<std::filesystem::path> MeshPlaces::find(
    const std::string& uri, std::vector<std::filesystem::path>& looked_for) const {
  const auto look_at = [&](const std::filesystem::path& place) {
    const std::filesystem::path normal = place.lexically_normal();
    if (std::ranges::find(looked_for, normal) == looked_for.end()) looked_for.push_back(normal);
  };
  const auto begins = [&](std::string_view scheme) { return uri.starts_with(scheme); };
  if (begins("package://") || begins("model://")) {
    const std::string rest = uri.substr(uri.find("://") + 3);
    const std::string in_package = rest.substr(std::min(rest.find('/') + 1, rest.size()));
    for (const std::string& folder : options_->package_dirs) {
      look_at(std::filesystem::path(folder) / rest);
      look_at(std::filesystem::path(folder) / in_package);
      look_at(std::filesystem::path(folder) / std::filesystem::path(rest).filename());
    }
    // Packages are in a folder of their name, next to the file or above it, or in one whose
    // package.xml gives them the name.
    const std::string package = rest.substr(0, rest.find('/'));
    std::filesystem::path folder =
        std::filesystem::absolute(folder_.empty() ? "." : folder_).lexically_normal();
    std::vector<std::filesystem::path> around;
    for (int i = 0; i < 8; ++i) {
      around.push_back(folder);
      look_at(folder / rest);
      if (begins("model://")) look_at(folder / "models" / rest);
      if (folder == folder.parent_path()) break;
      folder = folder.parent_path();
    }
    if (begins("package://")) {
      around.insert(around.begin(), options_->package_dirs.begin(), options_->package_dirs.end());
      for (const std::filesystem::path& named : folders_of_package(package, around))
        look_at(named / in_package);
    }
  } else if (begins("file://")) {
    look_at(uri.substr(std::string_view("file://").size()));
    look_at(folder_ / uri.substr(std::string_view("file://").size()));
  } else {
    look_at(folder_ / uri);
    for (const std::string& folder : options_->package_dirs) {
      look_at(std::filesystem::path(folder) / uri);
      look_at(std::filesystem::path(folder) / std::filesystem::path(uri).filename());
    }
  }
  std::error_code error;
  for (const std::filesystem::path& place : looked_for)
    if (std::filesystem::is_regular_file(place, error)) return place;
  return std::nullopt;
}

std::optional<std::filesystem::path> MeshPlaces::find(
    const std::string& uri, const std::vector<std::filesystem::path>& also_in,
    std::vector<std::filesystem::path>& looked_for) const {
  std::optional<std::filesystem::path> file = find(uri, looked_for);
  for (const std::filesystem::path& folder : also_in)
    if (!file) file = MeshPlaces(folder, *options_).find(uri, looked_for);
  return file;
}

}  // namespace minkray
