// SPDX-License-Identifier: MIT
#include "renderer/scene/write_scene.h"

#include "renderer/base/errors.h"
#include "renderer/json/json.h"
#include "renderer/scene/half_space_json.h"
#include "renderer/scene/mesh_json.h"
#include "renderer/scene/read_visible_to.h"
#include "renderer/scene/scene_json.h"
#include "renderer/scene/shape_json.h"
#include "renderer/scene/write_member.h"

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
  write_member(json, "matrix", AffineMap<double>(pose));
  return json;
}

Json object_json(const Object& object, const Scene& scene) {
  Json json;
  json["name"] = object.name;
  if (object.mesh)
    json["mesh"] = write_mesh(*object.mesh);
  else
    json["shape"] =
        object.half_space ? write_half_space(*object.half_space) : write_shape(object.shape);
  json["material"] = scene.materials[object.material].name;
  const Affine<double>& pose = object.motion ? object.motion->rest : object.pose;
  if (!(pose == Affine<double>())) json["transform"] = pose_json(pose);
  write_visible_to(json, object.visible_to);
  if (!object.motion) return json;
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
  json["version"] = scene_version;
  if (!scene.description.empty()) json["description"] = scene.description;
  json["camera"] = Json::object();
  write_members(json["camera"], scene.camera);
  json["lights"] = Json::array();
  for (const Light& light : scene.lights)
    json["lights"].push_back(std::visit(
        [](const auto& kind) {
          Json written = tagged(kind);
          if constexpr (requires { kind.strength; }) written["intensity"] = kind.strength;
          return written;
        },
        light));
  json["materials"] = Json::array();
  for (const Material& material : scene.materials) {
    Json written = std::visit([](const auto& kind) { return tagged(kind); }, material.kind);
    written["name"] = material.name;
    if (material.relief.any()) write_members(written, material.relief);
    write_visible_to(written, material.visible_to);
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
