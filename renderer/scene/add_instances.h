// SPDX-License-Identifier: MIT
// A scene's things become instances of a world, in the order of scene_instances.h.
#pragma once

#include "core/world/instances.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {

inline void add_object(Instances& instances, const Object& object) {
  if (object.half_space)
    instances.add(*object.half_space, object.pose);
  else if (object.mesh)
    instances.add(object.mesh, object.pose);
  else if (object.compound)
    instances.add(object.compound, object.pose);
  else if (object.definition)
    instances.add(instances.define(object.definition), object.pose);
  else
    instances.add(object.shape, object.pose);
}

inline void add_particles(Instances& instances, const Scene& scene) {
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(),
                       [&](std::size_t i) { return set.pose(i); });
}

/// Call when all are added: sets which rays meet which of them.
inline void show_instances(Instances& instances, const Scene& scene) {
  if (!any_is_hidden(scene)) return;
  for (std::size_t i = 0; i < instances.size(); ++i)
    instances.show_to(i, instance_visible_to(scene, i));
}

}  // namespace minkray
