// SPDX-License-Identifier: MIT
#include "renderer/scene_json/read_visible_to.h"

#include <algorithm>

#include "core/support/named_kind.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

constexpr std::string_view key = "visible_to";

bool may_shine(const Scene& scene, const MaterialKind& material) {
  const auto* mix = std::get_if<MixMaterial>(&material);
  return std::holds_alternative<EmissiveMaterial>(material) ||
         (mix &&
          std::any_of(mix->materials.indices.begin(), mix->materials.indices.end(),
                      [&](std::uint32_t i) { return may_shine(scene, scene.materials[i].kind); }));
}

}  // namespace

RayKinds read_visible_to(ObjectReader& object) {
  const Json* const json = object.find(key);
  if (!json) return all_ray_kinds;
  const JsonPath path = object.path(key);
  Mistakes& mistakes = object.mistakes();
  if (!json->is_array()) {
    mistakes.add(path, "must be a list of names of rays (" + found(*json) + ")");
    return all_ray_kinds;
  }
  RayKinds kinds = 0;
  for (std::size_t i = 0; i < json->size(); ++i) {
    const auto name = read_string((*json)[i], path / i, mistakes);
    if (!name) continue;
    const auto* known = row_named(ray_kinds_names, *name);
    if (!known) {
      mistakes.add(path / i, "must be the name of rays (" + found((*json)[i]) + "; " +
                                 suggestion(*name, names_in(ray_kinds_names)) + ")");
    } else if (kinds & known->kind) {
      mistakes.add(path / i, "duplicate (" + found((*json)[i]) + " again)");
    } else {
      kinds = static_cast<RayKinds>(kinds | known->kind);
    }
  }
  return kinds;
}

void check_visible(const Scene& scene, std::uint32_t material, RayKinds visible_to,
                   const ObjectReader& object) {
  constexpr RayKinds bring_light = shadow_rays | scattered_rays;
  if (material >= scene.materials.size()) return;  // already reported
  const Material& its = scene.materials[material];
  if ((visible_to & its.visible_to & bring_light) == bring_light || !may_shine(scene, its.kind))
    return;
  object.mistakes().add(object.path(key),
                        "must contain \"shadow\" and \"scattered\" for an emissive material (\"" +
                            printable(its.name, 60) + "\")");
}

void write_visible_to(Json& object, RayKinds visible_to) {
  if (visible_to == all_ray_kinds) return;
  Json names = Json::array();
  for (const auto& known : ray_kinds_names)
    if (visible_to & known.kind) names.push_back(std::string(known.name));
  object[std::string(key)] = std::move(names);
}

Json visible_to_schema() {
  std::string doc = "the rays that hit it; others pass through; by default all";
  for (const auto& known : ray_kinds_names)
    doc += "; " + std::string(known.name) + ": " + std::string(known.doc);
  return {{"type", "array"},
          {"description", doc},
          {"items", {{"enum", names_in(ray_kinds_names)}}},
          {"uniqueItems", true}};
}

}  // namespace minkray
