// SPDX-License-Identifier: MIT
#include "bench/image/subject.h"

#include "bench/image/clock.h"
#include "bench/image/temporary_folder.h"
#include "core/derived/convert.h"
#include "core/derived/shape_bounds.h"
#include "renderer/generate/generate.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene/scene_json.h"

namespace minkray::bench {

std::size_t Subject::objects() const {
  return instance_count(scene);
}

Subject make_subject(const std::string& kind, std::size_t objects) {
  const bool rounded = kind == "rounded-hulls";
  const TemporaryFolder folder;
  const std::string file = folder.path() / "scene.json";
  Subject subject;
  subject.kind = kind;
  const Clock generating;
  generate_scene({rounded ? "hulls" : kind, objects, 0}, file);
  subject.generate_seconds = generating.seconds();
  const Clock loading;
  subject.scene = load_scene(file);
  subject.load_seconds = loading.seconds();
  if (rounded)
    for (Object& object : subject.scene.objects) {
      const double size = bounds_of<double>(object.shape).half_extents().maxCoeff();
      object.shape = Rounded<double>{0.1 * size, object.shape};
    }
  return subject;
}

std::vector<Shape<double>> shapes_of(const Scene& scene) {
  std::vector<Shape<double>> shapes;
  for (const Object& object : scene.objects) shapes.push_back(object.shape);
  for (const ParticleSet& set : scene.particles) shapes.push_back(set.shape);
  return shapes;
}

void for_each_instance(const Scene& scene,
                       const std::function<void(std::uint32_t, const Affine<double>&)>& take) {
  std::uint32_t shape = 0;
  for (const Object& object : scene.objects) take(shape++, object.pose);
  for (const ParticleSet& set : scene.particles) {
    for (std::size_t i = 0; i < set.size(); ++i) take(shape, set.pose(i));
    ++shape;
  }
}

template <class T>
Instances<T> instances_of(const Scene& scene) {
  Instances<T> instances;
  instances.reserve(instance_count(scene));
  for (const Object& object : scene.objects)
    instances.add(convert<T>(object.shape), object.pose.cast<T>());
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(convert<T>(set.shape)), set.size(), set.linear_alike(),
                       [&](std::size_t i) { return set.pose(i).cast<T>(); });
  return instances;
}

template Instances<float> instances_of(const Scene&);
template Instances<double> instances_of(const Scene&);

}  // namespace minkray::bench
