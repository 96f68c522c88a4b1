// SPDX-License-Identifier: MIT
// The things in a scene one by one, whether they are objects or particles: first all objects, then
// the particles of one set after the other. Worlds number their instances the same way.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

/// No scene has more, so that hierarchies can number their nodes.
inline constexpr std::size_t most_instances = std::size_t{1} << 30;

inline std::size_t instance_count(const Scene& scene) {
  std::size_t count = scene.objects.size();
  for (const ParticleSet& set : scene.particles) count += set.size();
  return count;
}

/// Where the i-th instance stands.
inline Affine<double> instance_pose(const Scene& scene, std::size_t i) {
  if (i < scene.objects.size()) return scene.objects[i].pose;
  i -= scene.objects.size();
  for (const ParticleSet& set : scene.particles) {
    if (i < set.size()) return set.pose(i);
    i -= set.size();
  }
  return {};
}

/// What it does while the shutter is open.
inline Movement<double> instance_movement(const Scene& scene, std::size_t i) {
  return i < scene.objects.size() ? scene.objects[i].movement : Movement<double>();
}

/// Makes it an object of its own; a particle's name is that of its set with its number:
/// "grains[12]". It is for single ones, not for millions.
inline Object instance_object(const Scene& scene, std::size_t i) {
  if (i < scene.objects.size()) return scene.objects[i];
  i -= scene.objects.size();
  for (const ParticleSet& set : scene.particles) {
    if (i < set.size())
      return {set.name + "[" + std::to_string(i) + "]", set.shape, set.pose(i), set.material(i)};
    i -= set.size();
  }
  return {};
}

}  // namespace minkray
