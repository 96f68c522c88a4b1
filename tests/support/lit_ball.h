// SPDX-License-Identifier: MIT
// A small scene for path tracing.
#pragma once

#include "renderer/scene/scene.h"
#include "tests/support/shifted.h"

namespace minkray {

/// A matt ball on a floor under a lamp.
inline Scene lit_ball(const Resolution& resolution) {
  Scene scene;
  scene.camera.position = {0, -6, 2};
  scene.camera.resolution = resolution;
  scene.materials = {{"matt", LambertMaterial{Colour::Constant(0.7)}},
                     {"lamp", EmissiveMaterial{Colour::Constant(8)}}};
  const auto add = [&](Shape shape, const Vec3<double>& at, std::uint32_t material) {
    scene.objects.push_back({"", std::move(shape), shifted_by(at), material});
  };
  add(Box{{3, 3, 0.5}}, {0, 0, -1.5}, 0);
  add(Sphere{1}, {0, 0, 0}, 0);
  add(Sphere{0.4}, {2, -1, 3}, 1);
  return scene;
}

}  // namespace minkray
