// SPDX-License-Identifier: MIT
#include <algorithm>

#include "renderer/scene/scene.h"

namespace minkray {

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
}

}  // namespace minkray
