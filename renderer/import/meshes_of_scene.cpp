// SPDX-License-Identifier: MIT
#include "renderer/import/meshes_of_scene.h"

#include <algorithm>
#include <utility>

#include "core/shape/hull.h"
#include "renderer/import/mesh/mesh_library.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/scene_json/read_split.h"
#include "renderer/scene_json/scene_files.h"

namespace minkray {
namespace {

/// A file, and what is made of it.
struct ShownFile {
  std::string name;
  MeshChoice meshes = MeshChoice::hull;
  MeshSplit split = MeshSplit::none;
  double scale = 1;
  bool operator==(const ShownFile&) const = default;
};

MeshSplit split_of(const Json& object) {
  const Json* written = object.find("split");
  if (written && written->is_string())
    if (const auto* known = row_named(mesh_splits_of_files, written->text())) return known->kind;
  return MeshSplit::none;
}

/// Hulls of files may occur anywhere in shapes of shapes; a split is next to the shape itself.
void find_files(const Json& json, MeshSplit split, std::vector<ShownFile>& files) {
  const auto add = [&](const ShownFile& found) {
    if (std::ranges::find(files, found) == files.end()) files.push_back(found);
  };
  if (json.is_array())
    for (const Json& element : json) find_files(element, MeshSplit::none, files);
  if (!json.is_object()) return;
  const Json *type = json.find("type"), *file = json.find("file");
  if (type && type->is_string() && type->text() == Hull::name && file && file->is_string()) {
    add({file->text(), MeshChoice::hull, split});
  }
  if (const Json* mesh = json.find("mesh"); mesh && mesh->is_object()) {
    const Json *name = mesh->find("file"), *scale = mesh->find("scale");
    if (name && name->is_string())
      add({name->text(), MeshChoice::exact, MeshSplit::none,
           scale && scale->is_number() ? scale->get<double>() : 1});
  }
  for (const auto& [key, value] : json.members())
    find_files(value, key == "shape" ? split_of(json) : MeshSplit::none, files);
}

}  // namespace

std::vector<ModelMesh> meshes_of_scene(const std::filesystem::path& scene_file) {
  Mistakes mistakes(scene_file.string());
  const auto text = read_text_file(scene_file, mistakes);
  std::vector<ShownFile> files;
  if (text) {
    const SceneFiles scene(*text, scene_file.parent_path(), mistakes);
    for (const auto& file : scene.all()) {
      std::vector<ShownFile> named;
      find_files(file->json, MeshSplit::none, named);
      for (ShownFile& found : named) {
        if (!file->folder.empty()) found.name = (file->folder / found.name).string();
        if (std::ranges::find(files, found) == files.end()) files.push_back(found);
      }
    }
  }
  std::vector<ModelMesh> meshes;
  for (const ShownFile& file : files) {
    ImportOptions options;
    options.split = file.split;
    options.meshes = file.meshes;
    MeshLibrary library(scene_file.parent_path(), options);
    library.parts_of(file.name, Vec3<double>::Constant(file.scale));
    Model model;
    library.hand_over(model);
    for (ModelMesh& mesh : model.meshes) meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace minkray
