// SPDX-License-Identifier: MIT
#include "renderer/scene/append_materials.h"

#include <set>
#include <utility>

#include "core/files/mesh_attributes.h"

namespace minkray {
namespace {

void shift_mixed(MaterialKind& kind, std::uint32_t shift) {
  if (auto* mix = std::get_if<MixMaterial>(&kind))
    for (std::uint32_t& index : mix->materials.indices) index += shift;
}

/// Objects may share a look: the shifted one is a copy.
std::shared_ptr<const MeshLook> shifted(const MeshLook& look, std::uint32_t shift) {
  auto copy = std::make_shared<MeshLook>(look);
  for (std::uint32_t& index : copy->materials)
    if (index != MeshAttributes::none) index += shift;
  return copy;
}

void name_mixed(MaterialKind& kind, const std::vector<Material>& materials) {
  auto* mix = std::get_if<MixMaterial>(&kind);
  if (!mix) return;
  const auto& [first, second] = mix->materials.indices;
  mix->materials.names = std::make_shared<const std::array<std::string, 2>>(
      std::array{materials[first].name, materials[second].name});
}

}  // namespace

void append_materials(Scene& to, Scene& from) {
  const auto shift = static_cast<std::uint32_t>(to.materials.size());
  for (Material& material : from.materials) {
    shift_mixed(material.kind, shift);
    to.materials.push_back(std::move(material));
  }
  for (KeysOf<MaterialKind>& keys : from.material_keys) {
    keys.index += shift;
    shift_mixed(keys.keys.rest, shift);
    to.material_keys.push_back(std::move(keys));
  }
  for (Object& object : from.objects) {
    object.material += shift;
    if (object.look && shift > 0) object.look = shifted(*object.look, shift);
  }
  for (ParticleSet& set : from.particles)
    for (std::uint32_t& material : set.materials) material += shift;
}

void make_names_unique(Scene& scene) {
  std::set<std::string> taken;
  for (Material& material : scene.materials)
    while (!taken.insert(material.name).second) material.name += "'";
  for (Material& material : scene.materials) name_mixed(material.kind, scene.materials);
  for (KeysOf<MaterialKind>& keys : scene.material_keys)
    name_mixed(keys.keys.rest, scene.materials);
}

}  // namespace minkray
