// SPDX-License-Identifier: MIT
// The scenes that are measured: made by `minkray generate`, read as any scene, so that everybody
// gets the same objects.
#pragma once

#include <functional>
#include <string>

#include "core/world/instances.h"
#include "renderer/scene/scene.h"

namespace minkray::bench {

struct Subject {
  std::string kind;
  Scene scene;
  double load_seconds = 0;  ///< reading the file, for all tracers alike
  double generate_seconds = 0;

  std::size_t objects() const;
};

/// A kind of `minkray generate`, or one of its scenes with other shapes: "rounded-hulls" (its
/// hulls, each rounded by a tenth of its size), "hulls-16" and "hulls-64" (one hull of that many
/// points of an ellipsoid instead of rounded boxes), "mixed" (eight kinds of shapes instead).
Subject make_subject(const std::string& kind, std::size_t objects);

/// All shapes there are, each once.
std::vector<Shape> shapes_of(const Scene& scene);

/// Calls take(which of the shapes, pose) for each instance in order.
void for_each_instance(const Scene& scene,
                       const std::function<void(std::uint32_t, const Affine<double>&)>& take);

Instances instances_of(const Scene& scene);

}  // namespace minkray::bench
