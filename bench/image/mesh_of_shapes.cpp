// SPDX-License-Identifier: MIT
#include "bench/image/mesh_of_shapes.h"

#include "bench/image/clock.h"
#include "bench/image/rounded_mesh.h"
#include "bench/image/subject.h"
#include "core/derived/shape_bounds.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {

std::size_t Meshes::triangles() const {
  std::size_t count = 0;
  for (const TriangleMesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

TriangleMesh mesh_of_shape(const Shape& shape, double relative_error) {
  const double error = relative_error * ball_around(bounds_of(shape)).radius;
  if (std::optional<TriangleMesh> mesh = rounded_mesh(shape, error)) return *std::move(mesh);
  return tessellate(shape, error);
}

Meshes meshes_of(const Scene& scene, double relative_error) {
  const Clock clock;
  const std::vector<Shape> shapes = shapes_of(scene);
  Meshes meshes;
  meshes.relative_error = relative_error;
  meshes.meshes.resize(shapes.size());
  parallel_for(shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      meshes.meshes[i] = mesh_of_shape(shapes[i], relative_error);
  });
  meshes.seconds = clock.seconds();
  return meshes;
}

}  // namespace minkray::bench
