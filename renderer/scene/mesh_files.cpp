// SPDX-License-Identifier: MIT
#include "renderer/scene/mesh_files.h"

#include <exception>

#include "core/shape/mesh_file.h"

namespace minkray {
namespace {

/// A file next to this one in a folder of meshes that are fetched, not committed: how to get them.
constexpr const char* fetch_script = "fetch-meshes";

/// " (fetch it with ...)" if the file is missing from a folder that has such a script beside it.
std::string advice(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error)) return "";
  const std::filesystem::path script = file.parent_path().parent_path() / fetch_script;
  if (!std::filesystem::exists(script, error)) return "";
  return "; fetch it with: " + script.lexically_normal().string();
}

}  // namespace

std::optional<PointCloud<double>> MeshFiles::read(const std::string& name, const JsonPath& path,
                                                  Mistakes& mistakes) {
  const auto known = read_.find(name);
  if (known != read_.end()) return known->second;
  const std::filesystem::path file = folder_ / name;
  try {
    PointCloud<double> points(read_mesh_vertices(file), name);
    read_.emplace(name, points);
    return points;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + error.what() + advice(file));
    return std::nullopt;
  }
}

}  // namespace minkray
