// SPDX-License-Identifier: MIT
// A scene's things become instances of a world, in the order of scene_instances.h.
#pragma once

#include "core/world/instances.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {

template <class T>
void add_object(Instances<T>& instances, const Object& object) {
  if (object.half_space)
    instances.add(*object.half_space, object.pose);
  else if (std::is_same_v<T, double> && object.definition) {
    if constexpr (std::is_same_v<T, double>)
      instances.add(instances.define(object.definition), object.pose);
  } else
    instances.add(object.shape, object.pose);
}

template <class T>
void add_particles(Instances<T>& instances, const Scene& scene) {
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(), set.linear_alike(),
                       [&](std::size_t i) { return set.pose(i); });
}

/// Once all are added: tells which rays meet which of them.
template <class T>
void show_instances(Instances<T>& instances, const Scene& scene) {
  if (!any_is_hidden(scene)) return;
  for (std::size_t i = 0; i < instances.size(); ++i)
    instances.show_to(i, instance_visible_to(scene, i));
}

}  // namespace minkray
