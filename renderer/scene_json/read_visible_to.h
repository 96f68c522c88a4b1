// SPDX-License-Identifier: MIT
// "visible_to" of objects, particles and materials: a list of names of rays.
#pragma once

#include "renderer/json/object_reader.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// All rays, where the key is not there or wrong.
RayKinds read_visible_to(ObjectReader& object);

/// Adds a mistake if an emissive object is invisible to rays that carry its light.
void check_visible(const Scene& scene, std::uint32_t material, RayKinds visible_to,
                   const ObjectReader& object);

/// Adds the key, unless the thing is visible to all.
void write_visible_to(Json& object, RayKinds visible_to);

/// The key's schema.
Json visible_to_schema();

}  // namespace minkray
