// SPDX-License-Identifier: MIT
#include "bench/image/memory.h"

#include <malloc.h>

#include "bench/image/tracers.h"
#include "renderer/generate/random.h"

namespace minkray::bench {
namespace {

Scene unshared_boxes(std::size_t count) {
  Random random(0);
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> half(random.within(0.3, 0.5), random.within(0.3, 0.5),
                            random.within(0.3, 0.5));
    const std::array<double, 4> q = random.rotation();
    scene.objects.push_back({"",
                             Rounded{0.1, Shape(Box{half})},
                             {rotation_matrix(q[0], q[1], q[2], q[3]), random.in_cube(100)},
                             0});
  }
  return scene;
}

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

}  // namespace

MemoryOfUnshared measure_memory(std::size_t exact_objects, std::size_t meshes,
                                double relative_error) {
  MemoryOfUnshared memory;
  {
    const Scene scene = unshared_boxes(exact_objects);
    const double before = heap_bytes();
    const std::unique_ptr<Tracer> tracer = exact_shapes(scene);
    memory.our_heap_bytes = (heap_bytes() - before) / static_cast<double>(exact_objects);
    memory.our_bytes = static_cast<double>(tracer->bytes()) / static_cast<double>(exact_objects);
  }
  const Scene scene = unshared_boxes(meshes);
  const Meshes triangles = meshes_of(scene, relative_error);
  const std::unique_ptr<Tracer> tracer = embree_triangles(scene, triangles, false, 1);
  memory.triangles = static_cast<double>(triangles.triangles()) / static_cast<double>(meshes);
  memory.triangle_bytes = static_cast<double>(tracer->bytes()) / static_cast<double>(meshes);
  return memory;
}

}  // namespace minkray::bench
