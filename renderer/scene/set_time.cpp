// SPDX-License-Identifier: MIT
#include <algorithm>

#include "renderer/base/errors.h"
#include "renderer/json/json.h"
#include "renderer/scene/find_focus.h"
#include "renderer/scene/fitting_keys.h"
#include "renderer/scene/scene.h"

namespace minkray {
namespace {

void set_time_of_members(Scene& scene, double time) {
  for (const KeysOf<Light>& keyed : scene.light_keys) {
    Light& light = scene.lights[keyed.index];
    light = keyed.keys.at(time);
    std::visit([&](auto& kind) { kind.scale(keyed.keys.intensity_at(time)); }, light);
  }
  for (const KeysOf<MaterialKind>& keyed : scene.material_keys)
    scene.materials[keyed.index].kind = keyed.keys.at(time);
}

void set_time_of_camera(Scene& scene, double time) {
  CameraDescription& camera = scene.camera;
  camera = scene.camera_keys->at(time);
  Mistakes mistakes("camera at " + Json(time).dump() + " s");
  choose_up(camera);
  check_view(camera, JsonPath(), mistakes);
  find_focus(scene, JsonPath(), mistakes);
  throw_if_any(mistakes);
}

}  // namespace

bool moves(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& object) { return object.motion.has_value(); });
}

void set_time(Scene& scene, double time) {
  scene.time = time;
  const double shutter = scene.camera.shutter;
  for (Object& object : scene.objects) {
    if (!object.motion) continue;
    object.pose = object.motion->pose_at(time);
    object.movement = {};
    if (shutter > 0) object.movement = object.motion->movement(time, time + shutter);
  }
  set_time_of_members(scene, time);
  if (scene.camera_keys) set_time_of_camera(scene, time);
}

}  // namespace minkray
