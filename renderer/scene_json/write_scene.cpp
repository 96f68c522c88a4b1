// SPDX-License-Identifier: MIT
#include "renderer/scene_json/write_scene.h"

#include "renderer/base/errors.h"
#include "renderer/json/json.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/half_space_json.h"
#include "renderer/scene_json/mesh_json.h"
#include "renderer/scene_json/read_visible_to.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

template <class S>
Json tagged(const S& described) {
  Json json = {{"type", std::string(S::name)}};
  write_members(json, described);
  return json;
}

Json pose_json(const Affine<double>& pose) {
  Json json;
  MemberCodec<AffineMap>::write(json, "matrix", AffineMap(pose));
  return json;
}

bool needs_version_two(const Scene& scene) {
  return scene.camera_keys || !scene.light_keys.empty() || !scene.material_keys.empty();
}

/// Those parameters that each key names.
template <class V>
Json keys_json(const MemberKeys<V>& keys) {
  Json list = Json::array();
  for (std::size_t i = 0; i < keys.keys.size(); ++i) {
    const MemberKey<V>& key = keys.keys[i];
    Json written;
    written["time"] = key.time;
    visit_struct(key.values, [&]<class S>(const S& values) {
      std::uint64_t bit = 1;
      for_each_field<S>([&](const auto& field) {
        using M = typename std::remove_cvref_t<decltype(field)>::Member;
        if (key.given & bit) MemberCodec<M>::write(written, field.name, values.*(field.member));
        bit <<= 1;
      });
    });
    if (key.given & intensity_bit) written["intensity"] = keys.intensities[i];
    list.push_back(std::move(written));
  }
  return list;
}

/// The keys of the thing with that index; null if it has none.
template <class V>
const MemberKeys<V>* keys_of(const std::vector<KeysOf<V>>& all, std::size_t index) {
  for (const KeysOf<V>& keyed : all)
    if (keyed.index == index) return &keyed.keys;
  return nullptr;
}

Json light_json(const Light& light) {
  return std::visit(
      [](const auto& kind) {
        Json written = tagged(kind);
        if constexpr (requires { kind.strength; }) written["intensity"] = kind.strength;
        return written;
      },
      light);
}

Json object_json(const Object& object, const Scene& scene) {
  Json json;
  json["name"] = object.name;
  if (object.mesh)
    json["mesh"] = write_mesh(*object.mesh, object.look.get(), scene);
  else
    json["shape"] =
        object.half_space ? write_half_space(*object.half_space) : write_shape(object.shape);
  json["material"] = scene.materials[object.material].name;
  const Affine<double>& pose = object.motion ? object.motion->rest : object.pose;
  if (!(pose == Affine<double>())) json["transform"] = pose_json(pose);
  write_visible_to(json, object.visible_to);
  if (!object.motion) return json;
  // The motion as it is: in version 2 about the origin of all, instead of the object's own.
  if (needs_version_two(scene)) json["pivot"] = Json::array({0, 0, 0});
  json["keys"] = Json::array();
  for (const PoseKey& key : object.motion->keys) {
    Json written;
    written["time"] = key.time;
    written["translate"] = to_json(key.translate);
    written["rotate"] = Json::array({key.rotate[0], key.rotate[1], key.rotate[2], key.rotate[3]});
    json["keys"].push_back(std::move(written));
  }
  return json;
}

}  // namespace

std::string scene_text(const Scene& scene) {
  if (!scene.particles.empty()) throw BadInput("a scene with particles is not written");
  Json json;
  json["version"] = needs_version_two(scene) ? newest_scene_version : scene_version;
  if (!scene.description.empty()) json["description"] = scene.description;
  if (scene.labels) json["labels"] = true;
  json["camera"] = Json::object();
  write_members(json["camera"], scene.camera_keys ? scene.camera_keys->rest : scene.camera);
  if (scene.camera_keys) json["camera"]["keys"] = keys_json(*scene.camera_keys);
  json["lights"] = Json::array();
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const auto* keys = keys_of(scene.light_keys, i);
    Json written = light_json(keys ? keys->rest : scene.lights[i]);
    if (keys) {
      written["intensity"] = keys->intensity;
      written["keys"] = keys_json(*keys);
    }
    json["lights"].push_back(std::move(written));
  }
  json["materials"] = Json::array();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const auto* keys = keys_of(scene.material_keys, i);
    Json written = std::visit([](const auto& kind) { return tagged(kind); },
                              keys ? keys->rest : material.kind);
    written["name"] = material.name;
    if (material.relief.any()) write_members(written, material.relief);
    write_visible_to(written, material.visible_to);
    if (keys) written["keys"] = keys_json(*keys);
    json["materials"].push_back(std::move(written));
  }
  json["objects"] = Json::array();
  for (const Object& object : scene.objects) json["objects"].push_back(object_json(object, scene));
  if (scene.background_is_sky) return json.dump(1) + "\n";
  json["background"] = Json::object();
  write_members(json["background"], scene.background);
  return json.dump(1) + "\n";
}

}  // namespace minkray
