// SPDX-License-Identifier: MIT
// Meshes that a triangle ray tracer draws instead of a scene's shapes: one for each of them.
#pragma once

#include "bench/tessellate.h"
#include "renderer/scene/scene.h"

namespace minkray::bench {

struct Meshes {
  double relative_error = 0;         ///< of each shape's bounding radius
  std::vector<TriangleMesh> meshes;  ///< in the order of shapes_of(scene)
  double seconds = 0;                ///< time to make them: no part of any time to image

  std::size_t triangles() const;
};

Meshes meshes_of(const Scene& scene, double relative_error);

/// The mesh is of one shape, with an error of that part of its bounding radius.
TriangleMesh mesh_of_shape(const Shape& shape, double relative_error);

}  // namespace minkray::bench
