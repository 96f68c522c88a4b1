// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/collada_looks.h"

#include <algorithm>
#include <utility>

#include "core/files/mtl_file.h"
#include "core/files/text.h"
#include "renderer/import/mesh/gltf_text.h"

namespace minkray {
namespace {

/// The diffuse part of an effect; null if it has none.
const XmlElement* diffuse_of(const XmlElement& effect) {
  const XmlElement* profile = effect.child("profile_COMMON");
  const XmlElement* technique = profile ? profile->child("technique") : nullptr;
  if (!technique) return nullptr;
  for (const XmlElement& model : technique->children)
    if (const XmlElement* diffuse = model.child("diffuse")) return diffuse;
  return nullptr;
}

std::optional<Rgba> colour_of_effect(const XmlElement& effect, XmlFiles& files) {
  const XmlElement* diffuse = diffuse_of(effect);
  const XmlElement* colour = diffuse ? diffuse->child("color") : nullptr;
  if (!colour) return std::nullopt;
  const auto v = files.numbers_in(*colour, colour->text, "color", 3, 4);
  if (!v) return std::nullopt;
  return Rgba{(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
}

const XmlElement* parameter(const XmlElement& profile, const std::string& sid) {
  for (const XmlElement& one : profile.children)
    if (one.name == "newparam" && one.attribute_or("sid") == sid) return &one;
  return nullptr;
}

/// The image of a texture: via a sampler and a surface (1.4), via a sampler (1.5), or by its
/// own name.
const XmlElement* image_of(const XmlElement& profile, const std::string& name,
                           const ColladaById& with_id, const ColladaTarget& target) {
  const XmlElement* given = parameter(profile, name);
  const XmlElement* sampler = given ? given->child("sampler2D") : nullptr;
  if (!sampler) return with_id(name);
  if (const XmlElement* instance = sampler->child("instance_image"))
    return target(*instance, "url");
  const XmlElement* source = sampler->child("source");
  const XmlElement* surface =
      source ? parameter(profile, std::string(without_blanks(source->text))) : nullptr;
  surface = surface ? surface->child("surface") : nullptr;
  const XmlElement* from = surface ? surface->child("init_from") : nullptr;
  return from ? with_id(std::string(without_blanks(from->text))) : nullptr;
}

std::filesystem::path file_of_image(const XmlElement& image, const std::filesystem::path& folder) {
  const XmlElement* from = image.child("init_from");
  if (!from) return {};
  const XmlElement* ref = from->child("ref");
  std::string uri(without_blanks(ref ? ref->text : from->text));
  if (uri.empty()) return {};
  if (uri.starts_with("file://")) uri = uri.substr(std::string_view("file://").size());
  return picture_file(folder, percent_decoded(uri));
}

}  // namespace

const XmlElement* collada_effect(const XmlElement& instance, const std::string& symbol,
                                 const ColladaTarget& target) {
  const XmlElement* bind = instance.child("bind_material");
  const XmlElement* common = bind ? bind->child("technique_common") : nullptr;
  if (!common) return nullptr;
  for (const XmlElement& one : common->children) {
    if (one.name != "instance_material" || one.attribute_or("symbol") != symbol) continue;
    const XmlElement* material = target(one, "target");
    const XmlElement* effect = material ? material->child("instance_effect") : nullptr;
    return effect ? target(*effect, "url") : nullptr;
  }
  return nullptr;
}

std::optional<MeshMaterial> collada_material(const XmlElement& effect, const ColladaById& with_id,
                                             const ColladaTarget& target, XmlFiles& files,
                                             const std::filesystem::path& folder) {
  MeshMaterial material;
  if (const auto rgba = colour_of_effect(effect, files)) {
    material.rgba = *rgba;
    return material;
  }
  const XmlElement* diffuse = diffuse_of(effect);
  const XmlElement* texture = diffuse ? diffuse->child("texture") : nullptr;
  if (!texture) return std::nullopt;
  const XmlElement* image =
      image_of(*effect.child("profile_COMMON"), texture->attribute_or("texture"), with_id, target);
  if (image) material.file = file_of_image(*image, folder);
  if (!material.has_picture()) return std::nullopt;
  return material;
}

std::string collada_name(const XmlElement& element) {
  return element.attribute_or("name", element.attribute_or("id"));
}

PartLook collada_look(std::vector<std::string> names, const XmlElement& geometry,
                      const XmlElement* instance, const ColladaTarget& target, XmlFiles& files) {
  PartLook look{std::move(names), {}};
  const XmlElement* mesh = geometry.child("mesh");
  if (!instance || !mesh) return look;
  for (const XmlElement& faces : mesh->children) {
    const std::string symbol = faces.attribute_or("material");
    if (symbol.empty()) continue;
    const double count = std::clamp(files.number(faces, "count").value_or(1), 1.0, 1e9);
    const XmlElement* effect = collada_effect(*instance, symbol, target);
    if (const auto rgba = effect ? colour_of_effect(*effect, files) : std::nullopt)
      look.colours[*rgba] += static_cast<std::size_t>(count);
  }
  return look;
}

}  // namespace minkray
