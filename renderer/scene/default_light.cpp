// SPDX-License-Identifier: MIT
#include "renderer/scene/default_light.h"

#include <algorithm>

namespace minkray {

void light_everything(Scene& scene) {
  const DirectionalLight sun{{-1.0, 0.45, -1.5}, Colour(2.3, 2.2, 2.05)};
  const bool sun_is_hidden = std::ranges::any_of(scene.objects, [&](const Object& object) {
    return object.half_space &&
           object.half_space->posed(object.pose).normal.dot(sun.direction) >= 0;
  });
  const CameraDescription& camera = scene.camera;
  if (sun_is_hidden)
    scene.lights.push_back(
        PointLight{camera.position, sun.colour * (camera.look_at - camera.position).squaredNorm()});
  else
    scene.lights.push_back(sun);
  scene.lights.push_back(EnvironmentLight{{0.62, 0.7, 0.82}, {0.3, 0.28, 0.26}});
  scene.background = default_background;
}

}  // namespace minkray
