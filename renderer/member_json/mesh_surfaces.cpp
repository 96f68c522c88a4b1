// SPDX-License-Identifier: MIT
// Mesh files as triangles with their attributes and materials.
#include <map>
#include <stdexcept>

#include "core/files/mesh_file.h"
#include "core/files/mtl_file.h"
#include "core/files/regular_file.h"
#include "core/mesh/weld.h"
#include "renderer/base/of_file.h"
#include "renderer/member_json/mesh_files.h"

namespace minkray {
namespace {

constexpr std::size_t most_library_bytes = std::size_t{16} << 20;

}  // namespace

std::vector<FileMaterial> MeshFiles::read_libraries(const std::filesystem::path& mesh,
                                                    const MeshAttributes& attributes,
                                                    const JsonPath& path, Mistakes& mistakes) {
  // Each picture's name is relative to its library.
  std::map<std::string, std::pair<MtlMaterial, std::filesystem::path>> known;
  for (const std::string& library : attributes.libraries) {
    const std::filesystem::path file = mesh.parent_path() / library;
    std::error_code error;
    // Meshes often come without their materials.
    if (!std::filesystem::exists(folder_ / file, error)) continue;
    std::map<std::string, MtlMaterial> materials;
    try {
      read_mtl(read_regular_file(folder_ / file, most_library_bytes), materials);
    } catch (const std::exception& wrong) {
      mistakes.add(path, printable((folder_ / file).string(), 200) + ": " + what_of(wrong));
      continue;
    }
    libraries_.push_back(folder_ / file);
    for (auto& [name, material] : materials)
      known.insert_or_assign(name, std::pair(std::move(material), file.parent_path()));
  }
  std::vector<FileMaterial> all;
  bool any = false;
  for (const std::string& name : attributes.materials) {
    FileMaterial& made = all.emplace_back(FileMaterial{name});
    const auto found = known.find(name);
    if (found == known.end()) continue;
    const auto& [material, folder] = found->second;
    made.colour = material.colour;
    if (!material.picture.empty()) {
      const std::string file =
          picture_file(folder_ / folder, material.picture).lexically_proximate(folder_).string();
      made.picture = {file, read_picture_of_scene(file, path, mistakes)};
    }
    any = any || made.colour || made.picture.image;
  }
  if (!any) all.clear();
  return all;
}

std::shared_ptr<const std::vector<FileMaterial>> MeshFiles::materials_of(const SceneMesh& mesh,
                                                                         const JsonPath& path,
                                                                         Mistakes& mistakes) {
  if (mesh.file.empty() || !mesh.attributes || mesh.attributes->materials.empty()) return nullptr;
  const auto [at, is_new] = materials_.try_emplace(mesh.file);
  if (!is_new) return at->second.all;
  std::vector<FileMaterial> all = read_libraries(mesh.file, *mesh.attributes, path, mistakes);
  if (all.empty()) return nullptr;
  Hash hash;
  for (const FileMaterial& material : all) {
    if (material.colour)
      hash.add({reinterpret_cast<const char*>(material.colour->data()), sizeof *material.colour});
    hash.add(material.picture.file);
  }
  at->second = {std::make_shared<const std::vector<FileMaterial>>(std::move(all)), hash.text()};
  return at->second.all;
}

SceneMesh MeshFiles::read_mesh(const std::string& written, double scale, const MeshShading& shading,
                               const JsonPath& path, Mistakes& mistakes) {
  const std::string name = from_scene(written);
  const SurfaceKey key(name, scale, shading);
  const auto known = surfaces_.find(key);
  if (known != surfaces_.end()) return known->second.mesh;
  const std::filesystem::path file = folder_ / name;
  try {
    MeshTriangles triangles;
    MeshAttributes attributes;
    std::vector<Vec3<double>> vertices = read_mesh_vertices(file, &triangles, &attributes);
    if (triangles.corners.empty())
      throw std::runtime_error("must have faces (found vertices only)");
    settle(attributes);
    if (shading.kind != MeshShading::as_given) {
      attributes.normals.clear();
      attributes.normal_of.clear();
      attributes.bad_normals = 0;
    }
    // Coordinates are checked where a texture needs them.
    if (attributes.bad_normals > 0)
      throw std::runtime_error(notes_of(attributes).front() +
                               "; \"smooth\": true or false leaves the file's normals out");
    for (Vec3<double>& vertex : vertices) vertex *= scale;
    weld(vertices, triangles.corners);
    if (shading.kind == MeshShading::smooth) {
      MeshAttributes smooth = smooth_normals(vertices, triangles.corners, shading.crease);
      attributes.normals = std::move(smooth.normals);
      attributes.normal_of = std::move(smooth.normal_of);
    }
    Surface surface;
    surface.mesh.file = name;
    surface.mesh.mesh =
        std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles.corners));
    Hash hash;
    const auto add = [&](const auto& items) {
      hash.add({reinterpret_cast<const char*>(items.data()), items.size() * sizeof items[0]});
    };
    add(surface.mesh.mesh->vertices());
    add(surface.mesh.mesh->triangles());
    if (attributes.any()) {
      add(attributes.normals);
      add(attributes.normal_of);
      add(attributes.uvs);
      add(attributes.uv_of);
      add(attributes.material_of);
      surface.mesh.attributes = std::make_shared<const MeshAttributes>(std::move(attributes));
    }
    surface.hash = hash.text();
    return surfaces_.emplace(key, std::move(surface)).first->second.mesh;
  } catch (const std::exception& error) {
    mistakes.add(path, printable(file.string(), 200) + ": " + what_of(error) +
                           advice_on_mesh(folder_, file));
    return {};
  }
}

}  // namespace minkray
