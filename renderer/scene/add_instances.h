// SPDX-License-Identifier: MIT
// A scene's things become instances of a world, in the order of scene_instances.h.
#pragma once

#include "core/world/instances.h"
#include "renderer/scene/scene.h"

namespace minkray {

template <class T>
void add_object(Instances<T>& instances, const Object& object) {
  if (object.half_space)
    instances.add(*object.half_space, object.pose);
  else
    instances.add(object.shape, object.pose);
}

template <class T>
void add_particles(Instances<T>& instances, const Scene& scene) {
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(), set.linear_alike(),
                       [&](std::size_t i) { return set.pose(i); });
}

}  // namespace minkray
