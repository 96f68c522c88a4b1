// SPDX-License-Identifier: MIT
#include "renderer/import/collada_looks.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace minkray {
namespace {

/// The diffuse colour bound to a material's symbol.
std::optional<Rgba> colour_of_symbol(const XmlElement& instance, const std::string& symbol,
                                     const ColladaTarget& target, XmlFiles& files) {
  const XmlElement* bind = instance.child("bind_material");
  const XmlElement* common = bind ? bind->child("technique_common") : nullptr;
  if (!common) return std::nullopt;
  for (const XmlElement& one : common->children) {
    if (one.name != "instance_material" || one.attribute_or("symbol") != symbol) continue;
    const XmlElement* material = target(one, "target");
    const XmlElement* effect = material ? material->child("instance_effect") : nullptr;
    effect = effect ? target(*effect, "url") : nullptr;
    const XmlElement* profile = effect ? effect->child("profile_COMMON") : nullptr;
    const XmlElement* technique = profile ? profile->child("technique") : nullptr;
    if (!technique) return std::nullopt;
    for (const XmlElement& model : technique->children) {
      const XmlElement* diffuse = model.child("diffuse");
      const XmlElement* colour = diffuse ? diffuse->child("color") : nullptr;
      if (!colour) continue;
      if (const auto v = files.numbers_in(*colour, colour->text, "color", 3, 4))
        return Rgba{(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
    }
  }
  return std::nullopt;
}

}  // namespace

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
    if (const auto rgba = colour_of_symbol(*instance, symbol, target, files))
      look.colours[*rgba] += static_cast<std::size_t>(count);
  }
  return look;
}

}  // namespace minkray
