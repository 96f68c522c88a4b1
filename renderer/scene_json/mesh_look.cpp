// SPDX-License-Identifier: MIT
#include "renderer/scene_json/mesh_look.h"

#include <algorithm>
#include <set>

#include "core/files/mesh_attributes.h"
#include "renderer/image/colour.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

Paint paint_of(const FileMaterial& material) {
  if (material.picture.image) return Paint(ImageTexture{material.picture, {"uv"}});
  Colour colour;
  for (int i = 0; i < 3; ++i)
    colour[i] = from_srgb((*material.colour)[static_cast<std::size_t>(i)]);
  return colour;
}

/// Materials that "materials" names: by numbers in a list, or by the names in the file.
std::vector<std::uint32_t> named_materials(const Json& written, const SceneMesh& mesh,
                                           const MaterialNames& materials, const JsonPath& path,
                                           Mistakes& mistakes) {
  std::vector<std::uint32_t> named;
  if (written.is_array()) {
    for (std::size_t i = 0; i < written.size(); ++i)
      named.push_back(materials.named(written[i], path / i, mistakes));
    return named;
  }
  const std::vector<std::string> none;
  const std::vector<std::string>& names = mesh.attributes ? mesh.attributes->materials : none;
  named.assign(names.size(), MeshAttributes::none);
  for (const auto& [name, value] : written.members()) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end())
      mistakes.add(path / name, "must be a material of the file; " + suggestion(name, names));
    else
      named[static_cast<std::size_t>(at - names.begin())] =
          materials.named(value, path / name, mistakes);
  }
  return named;
}

bool is_by_uv(const Paint& paint) {
  return paint.texture() &&
         std::visit([](const auto& kind) { return kind.mapping.name == "uv"; }, *paint.texture());
}

bool is_by_uv(const PaintIfAny& paint) {
  return paint && is_by_uv(*paint);
}

bool needs_uv(const Scene& scene, const Material& material) {
  if (is_by_uv(material.relief.bump) || is_by_uv(material.relief.normal_map)) return true;
  if (const auto* mix = std::get_if<MixMaterial>(&material.kind))
    return std::ranges::any_of(mix->materials.indices, [&](std::uint32_t i) {
      return needs_uv(scene, scene.materials[i]);
    });
  return std::visit(
      []<class M>(const M& kind) {
        if constexpr (
            requires { kind.colour.has_value(); } || requires { kind.colour.texture(); })
          return is_by_uv(kind.colour);
        else
          return false;
      },
      material.kind);
}

bool lets_through(const Scene& scene, const Material& material) {
  if (const auto* mix = std::get_if<MixMaterial>(&material.kind))
    return std::ranges::any_of(mix->materials.indices, [&](std::uint32_t i) {
      return lets_through(scene, scene.materials[i]);
    });
  const auto* layers = std::get_if<PrincipledMaterial>(&material.kind);
  return std::holds_alternative<DielectricMaterial>(material.kind) ||
         std::holds_alternative<TranslucentMaterial>(material.kind) ||
         (layers && layers->transmission > 0);
}

std::set<std::uint32_t> materials_of(const Object& object) {
  std::set<std::uint32_t> all = {object.material};
  if (object.look)
    for (const std::uint32_t i : object.look->materials)
      if (i != MeshAttributes::none) all.insert(i);
  return all;
}

std::size_t triangles_without_uv(const Object& object) {
  const MeshAttributes& attributes = *object.look->attributes;
  return static_cast<std::size_t>(std::ranges::count(attributes.uv_of, MeshAttributes::no_numbers));
}

}  // namespace

std::shared_ptr<const MeshLook> look_of(const SceneMesh& mesh, bool takes_file, Scene& scene,
                                        MaterialNames& materials, MeshFiles& files,
                                        const JsonPath& path, Mistakes& mistakes) {
  MeshLook look{mesh.attributes};
  if (mesh.named)
    look.materials = named_materials(*mesh.named, mesh, materials, path / "materials", mistakes);
  const auto of_files = takes_file ? files.materials_of(mesh, path / "file", mistakes) : nullptr;
  if (of_files) {
    look.materials.resize(of_files->size(), MeshAttributes::none);
    for (std::size_t i = 0; i < look.materials.size(); ++i) {
      const FileMaterial& of_file = (*of_files)[i];
      if (look.materials[i] == MeshAttributes::none && (of_file.colour || of_file.picture.image))
        look.materials[i] = materials.of_file(of_file.name, of_files.get(), paint_of(of_file));
    }
  }
  for (std::uint32_t& material : look.materials)
    if (material >= scene.materials.size()) material = MeshAttributes::none;
  if (!mesh.attributes) return nullptr;
  return std::make_shared<const MeshLook>(std::move(look));
}

void check_look(const Scene& scene, const Object& object, const JsonPath& path,
                Mistakes& mistakes) {
  const std::set<std::uint32_t> materials = materials_of(object);
  if (*materials.rbegin() >= scene.materials.size()) return;  // a mistake that has been reported
  for (const std::uint32_t i : materials) {
    const Material& material = scene.materials[i];
    const std::string of = " (material \"" + printable(material.name, 60) + "\")";
    if (needs_uv(scene, material)) {
      if (!object.mesh || !object.look || object.look->attributes->uv_of.empty())
        mistakes.add(
            path, "must be a mesh with texture coordinates for a texture of mapping \"uv\"" + of);
      else if (const std::size_t without = triangles_without_uv(object); without > 0)
        mistakes.add(path,
                     "must have texture coordinates for a texture of mapping \"uv\" at all "
                     "triangles (got " +
                         std::to_string(without) + " without)" + of);
    }
    const Material& own = scene.materials[object.material];
    if (i == object.material) continue;
    if (lets_through(scene, material) || lets_through(scene, own))
      mistakes.add(path, "must have a single material if any of its materials is transparent" + of);
    if (material.visible_to != own.visible_to)
      mistakes.add(path, "must have materials that are all visible to the same rays" + of);
  }
}

}  // namespace minkray
