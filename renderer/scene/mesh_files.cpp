// SPDX-License-Identifier: MIT
#include "renderer/scene/mesh_files.h"

#include <exception>

#include "core/shape/mesh_file.h"

namespace minkray {
namespace {

/// Meshes that are not part of the sources are fetched by a script of this name beside the scene.
constexpr const char* fetch_script = "fetch-meshes";

/// "; fetch it with: scenes/fetch-meshes" if the file is missing and there is such a script.
std::string advice(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path script = folder / fetch_script;
  if (std::filesystem::exists(file, error) || !std::filesystem::exists(script, error)) return "";
  return "; fetch it with: " + script.string();
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
    mistakes.add(path, printable(file.string(), 200) + ": " + error.what() + advice(folder_, file));
    return std::nullopt;
  }
}

}  // namespace minkray
