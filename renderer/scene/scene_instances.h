// SPDX-License-Identifier: MIT
// The things in a scene one by one, whether they are objects or particles: first all objects, then
// the particles of one set after the other. Worlds number their instances the same way.
#pragma once

#include <algorithm>

#include "renderer/scene/scene.h"

namespace minkray {

/// No scene has more, so that hierarchies can number their nodes.
inline constexpr std::size_t most_instances = std::size_t{1} << 30;

inline std::size_t instance_count(const Scene& scene) {
  std::size_t count = scene.objects.size();
  for (const ParticleSet& set : scene.particles) count += set.size();
  return count;
}

/// Pose of the i-th of all particles.
inline Affine<double> particle_pose(const Scene& scene, std::size_t i) {
  for (const ParticleSet& set : scene.particles) {
    if (i < set.size()) return set.pose(i);
    i -= set.size();
  }
  return {};
}

/// Pose of the i-th instance.
inline Affine<double> instance_pose(const Scene& scene, std::size_t i) {
  return i < scene.objects.size() ? scene.objects[i].pose
                                  : particle_pose(scene, i - scene.objects.size());
}

/// Motion of the i-th instance while the shutter is open.
inline Movement<double> instance_movement(const Scene& scene, std::size_t i) {
  return i < scene.objects.size() ? scene.objects[i].movement : Movement<double>();
}

/// The rays that meet the i-th.
inline RayKinds instance_visible_to(const Scene& scene, std::size_t i) {
  const auto with_material = [&](RayKinds own, std::uint32_t material) {
    return static_cast<RayKinds>(own & scene.materials[material].visible_to);
  };
  if (i < scene.objects.size())
    return with_material(scene.objects[i].visible_to, scene.objects[i].material);
  i -= scene.objects.size();
  for (const ParticleSet& set : scene.particles) {
    if (i < set.size()) return with_material(set.visible_to, set.material(i));
    i -= set.size();
  }
  return all_ray_kinds;
}

/// True if any object or particle set is invisible to some rays.
inline bool any_is_hidden(const Scene& scene) {
  const auto is_hidden = [](const auto& thing) { return thing.visible_to != all_ray_kinds; };
  return std::any_of(scene.objects.begin(), scene.objects.end(), is_hidden) ||
         std::any_of(scene.particles.begin(), scene.particles.end(), is_hidden) ||
         std::any_of(scene.materials.begin(), scene.materials.end(), is_hidden);
}

/// Makes an object of one instance; a particle's name is its set's name with its number,
/// "grains[12]". Too slow for millions.
inline Object instance_object(const Scene& scene, std::size_t i) {
  if (i < scene.objects.size()) return scene.objects[i];
  i -= scene.objects.size();
  for (const ParticleSet& set : scene.particles) {
    if (i < set.size())
      return {.name = set.name + "[" + std::to_string(i) + "]",
              .shape = set.shape,
              .pose = set.pose(i),
              .material = set.material(i),
              .visible_to = set.visible_to};
    i -= set.size();
  }
  return {};
}

}  // namespace minkray
