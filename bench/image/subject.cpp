// SPDX-License-Identifier: MIT
#include "bench/image/subject.h"

#include "bench/image/clock.h"
#include "core/derived/shape_bounds.h"
#include "renderer/generate/generate.h"
#include "renderer/generate/random.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/temporary_folder.h"

namespace minkray::bench {

namespace {

/// Points of an ellipsoid; all of them are vertices.
Shape hull_of(int points) {
  Random random(7);
  std::vector<Vec3<double>> corners;
  for (int i = 0; i < points; ++i)
    corners.push_back(random.direction().cwiseProduct(Vec3<double>(0.75, 0.5, 0.35)));
  return Hull{PointCloud(corners)};
}

/// Gives the particles of the one set eight shapes in turn, a set for each.
void mix(Scene& scene) {
  const Box box{{0.5, 0.35, 0.2}};
  const std::vector<Shape> kinds = {Sphere{0.5},
                                    Ellipsoid{{0.75, 0.5, 0.35}},
                                    box,
                                    Rounded{0.1, Shape(box)},
                                    Capsule{0.25, 0.4},
                                    Cylinder{0.35, 0.4},
                                    Cone{0.45, 0.5},
                                    hull_of(16)};
  const ParticleSet all = std::move(scene.particles.at(0));
  scene.particles.clear();
  const std::size_t numbers = all.row_numbers();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    ParticleSet set = all;
    set.name += std::to_string(k);
    set.shape = kinds[k];
    set.poses.clear();
    for (std::size_t i = k; i < all.size(); i += kinds.size()) {
      const auto row = all.poses.begin() + static_cast<std::ptrdiff_t>(i * numbers);
      set.poses.insert(set.poses.end(), row, row + static_cast<std::ptrdiff_t>(numbers));
    }
    scene.particles.push_back(std::move(set));
  }
}

}  // namespace

std::size_t Subject::objects() const {
  return instance_count(scene);
}

Subject make_subject(const std::string& kind, std::size_t objects) {
  const bool rounded = kind == "rounded-hulls";
  const std::string generated = rounded                                         ? "hulls"
                                : kind == "mixed" || kind.starts_with("hulls-") ? "rounded-boxes"
                                                                                : kind;
  const TemporaryFolder folder;
  const std::string file = folder.path() / "scene.json";
  Subject subject;
  subject.kind = kind;
  const Clock generating;
  generate_scene({generated, objects, 0}, file);
  subject.generate_seconds = generating.seconds();
  const Clock loading;
  subject.scene = load_scene(file);
  subject.load_seconds = loading.seconds();
  if (rounded)
    for (Object& object : subject.scene.objects) {
      const double size = bounds_of(object.shape).half_extents().maxCoeff();
      object.shape = Rounded{0.1 * size, object.shape};
    }
  if (kind == "hulls-16" || kind == "hulls-64")
    subject.scene.particles.at(0).shape = hull_of(kind == "hulls-16" ? 16 : 64);
  if (kind == "mixed") mix(subject.scene);
  return subject;
}

std::vector<Shape> shapes_of(const Scene& scene) {
  std::vector<Shape> shapes;
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

Instances instances_of(const Scene& scene) {
  Instances instances;
  instances.reserve(instance_count(scene));
  for (const Object& object : scene.objects) instances.add(object.shape, object.pose);
  for (const ParticleSet& set : scene.particles)
    instances.add_many(instances.define(set.shape), set.size(),
                       [&](std::size_t i) { return set.pose(i); });
  return instances;
}

}  // namespace minkray::bench
