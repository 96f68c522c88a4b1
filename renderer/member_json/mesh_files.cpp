// SPDX-License-Identifier: MIT
#include "renderer/member_json/mesh_files.h"

#include <exception>
#include <stdexcept>

#include "core/files/mesh_file.h"
#include "renderer/base/of_file.h"
#include "renderer/io/read_image.h"

namespace minkray {
namespace {

/// Meshes outside the repository are fetched by a script of this name in the scene's folder.
constexpr const char* fetch_script = "fetch-meshes";

}  // namespace

std::string advice_on_mesh(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error)) return "";
  const std::filesystem::path script = folder / fetch_script;
  if (std::filesystem::exists(script, error)) return "; fetch it with: " + script.string();
  if (folder.parent_path().filename() == "minkray" && folder.filename() == "scenes")
    return "; it does not come with Minkray: scenes/fetch-meshes in Minkray's sources downloads it";
  return "";
}

std::optional<PointCloud> MeshFiles::read(const std::string& written, const JsonPath& path,
                                          Mistakes& mistakes) {
  const std::string name = from_scene(written);
  const auto known = read_.find(name);
  if (known != read_.end()) return known->second.points;
  const std::filesystem::path file = folder_ / name;
  try {
    std::vector<Vec3<double>> vertices = read_mesh_vertices(file);
    static_assert(sizeof(Vec3<double>) == 3 * sizeof(double));
    Hash hash;
    hash.add(
        {reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof vertices[0]});
    PointCloud points(std::move(vertices), name);
    read_.emplace(name, Mesh{points, hash.text()});
    return points;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + what_of(error) +
                           advice_on_mesh(folder_, file));
    return std::nullopt;
  }
}

std::optional<std::vector<PointCloud>> MeshFiles::read_parts(const std::string& written,
                                                             MeshSplit split, const JsonPath& path,
                                                             Mistakes& mistakes) {
  const std::string name = from_scene(written);
  const auto known = parts_.find({name, split});
  if (known != parts_.end()) return known->second.hulls;
  const std::filesystem::path file = folder_ / name;
  try {
    const MeshParts mesh = read_mesh_parts(file, split);
    Hash hash;
    hash.add({reinterpret_cast<const char*>(mesh.vertices.data()),
              mesh.vertices.size() * sizeof mesh.vertices[0]});
    Parts parts;
    if (mesh.parts.empty()) parts.hulls.emplace_back(mesh.vertices);
    for (const std::vector<std::uint32_t>& part : mesh.parts) {
      std::vector<Vec3<double>> vertices;
      vertices.reserve(part.size());
      for (const std::uint32_t i : part) vertices.push_back(mesh.vertices[i]);
      hash.add({reinterpret_cast<const char*>(part.data()), part.size() * sizeof part[0]});
      parts.hulls.emplace_back(std::move(vertices));
    }
    parts.hash = hash.text();
    return parts_.emplace(std::pair(name, split), std::move(parts)).first->second.hulls;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + what_of(error) +
                           advice_on_mesh(folder_, file));
    return std::nullopt;
  }
}

std::shared_ptr<const Image> MeshFiles::read_picture_of_scene(const std::string& name,
                                                              const JsonPath& path,
                                                              Mistakes& mistakes) {
  const auto known = pictures_.find(name);
  if (known != pictures_.end()) return known->second.image;
  const std::filesystem::path file = folder_ / name;
  try {
    const auto image = std::make_shared<const Image>(read_image(file, most_image_pixels - pixels_));
    pixels_ += static_cast<std::int64_t>(image->pixels.size());
    Hash hash;
    hash.add(std::to_string(image->width));
    hash.add({reinterpret_cast<const char*>(image->pixels.data()),
              image->pixels.size() * sizeof image->pixels[0]});
    pictures_.emplace(name, Picture{image, hash.text()});
    return image;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + what_of(error));
    return nullptr;
  }
}

std::vector<std::filesystem::path> MeshFiles::pictures() const {
  std::vector<std::filesystem::path> files;
  for (const auto& [name, picture] : pictures_) files.push_back(folder_ / name);
  for (const auto& [name, hash] : heights_) files.push_back(folder_ / name);
  return files;
}

std::vector<std::filesystem::path> MeshFiles::meshes() const {
  std::vector<std::filesystem::path> files;
  for (const auto& [name, mesh] : read_) files.push_back(folder_ / name);
  for (const auto& [key, parts] : parts_) files.push_back(folder_ / key.first);
  for (const auto& [key, surface] : surfaces_) files.push_back(folder_ / std::get<0>(key));
  files.insert(files.end(), libraries_.begin(), libraries_.end());
  return files;
}

std::optional<HeightGrid> MeshFiles::read_heights(const std::string& written, const JsonPath& path,
                                                  Mistakes& mistakes) {
  const std::string name = from_scene(written);
  const std::filesystem::path file = folder_ / name;
  try {
    HeightGrid grid = read_height_picture(file);
    Hash hash;
    hash.add(std::to_string(grid.columns));
    hash.add({reinterpret_cast<const char*>(grid.heights.data()),
              grid.heights.size() * sizeof grid.heights[0]});
    heights_[name] = hash.text();
    return grid;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + what_of(error));
    return std::nullopt;
  }
}

void MeshFiles::add_to(Hash& hash) const {
  for (const auto& [name, materials] : materials_) {
    hash.add(name);
    hash.add(materials.hash);
  }
  for (const auto& [name, text] : heights_) {
    hash.add(name);
    hash.add(text);
  }
  for (const auto& [name, picture] : pictures_) {
    hash.add(name);
    hash.add(picture.hash);
  }
  for (const auto& [name, mesh] : read_) {
    hash.add(name);
    hash.add(mesh.hash);
  }
  for (const auto& [key, parts] : parts_) {
    hash.add(key.first);
    hash.add(parts.hash);
  }
  for (const auto& [key, surface] : surfaces_) {
    hash.add(std::get<0>(key));
    hash.add(surface.hash);
  }
}

}  // namespace minkray
