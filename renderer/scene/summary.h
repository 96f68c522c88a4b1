// SPDX-License-Identifier: MIT
// Summarises a scene: number of shapes per kind, bounds, memory.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/math/bounds.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Number of shapes of a kind.
struct KindCount {
  std::string_view name;
  std::size_t objects = 0;   ///< as an object's own shape
  std::size_t operands = 0;  ///< inside others
};

struct SceneSummary {
  std::vector<KindCount> kinds;  ///< those that occur
  std::size_t hull_points = 0;   ///< extreme points kept by hulls
  std::size_t bytes = 0;         ///< of all objects and particles with their shapes and points
  std::size_t instances = 0;     ///< objects and particles
  std::size_t particles = 0;
  Bounds<double> bounds;  ///< in the world; empty if there are no objects
};

SceneSummary summarise(const Scene& scene);

/// The bounds of an object, or of all particles, in the world.
Bounds<double> bounds_of(const Object& object);
Bounds<double> bounds_of(const ParticleSet& set);

}  // namespace minkray
