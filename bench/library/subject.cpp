// SPDX-License-Identifier: MIT
#include "subject.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "random.h"

namespace bench {
namespace {

const Vec half_extents(0.5, 0.35, 0.2), radii(0.75, 0.5, 0.35);
constexpr double rounding = 0.1;
constexpr std::uint64_t hull_seed = 7;

struct Kind {
  std::vector<Body> bodies;
  double volume;  ///< about, of one object
};

Kind kind_of(const std::string& name) {
  const auto hull_of = [](int count) { return hull(random_points(count, radii, hull_seed)); };
  if (name == "rounded boxes") return {{rounded_box(half_extents, rounding)}, 0.7};
  if (name == "spheres") return {{sphere(0.5)}, 0.5236};
  if (name == "ellipsoids") return {{ellipsoid(radii)}, 0.5498};
  if (name == "hulls of 16") return {{hull_of(16)}, 0.7};
  if (name == "hulls of 64") return {{hull_of(64)}, 0.7};
  if (name == "eight kinds")
    return {{sphere(0.5), ellipsoid(radii), box(half_extents), rounded_box(half_extents, rounding),
             capsule(0.25, 0.4), cylinder(0.35, 0.4), cone(0.45, 0.5), hull_of(16)},
            0.7};
  throw std::logic_error("no such kind of scene: " + name);
}

}  // namespace

double Subject::least_radius() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies) least = std::min(least, body.radius);
  return least;
}

Subject make_subject(const std::string& kind, std::size_t objects) {
  // Part of the cube that the objects fill, overlaps counted twice.
  constexpr double fill = 0.15;
  auto [bodies, volume] = kind_of(kind);
  Subject subject{
      std::move(bodies), {}, std::cbrt(static_cast<double>(objects) * volume / fill) / 2};
  Random random(0);
  subject.objects.reserve(objects);
  for (std::size_t i = 0; i < objects; ++i) {
    const Vec place = random.in_cube(subject.half_size);
    subject.objects.push_back({i % subject.bodies.size(), mk::pose(place, random.rotation())});
  }
  return subject;
}

mk::Scene scene_of(const Subject& subject) {
  mk::Scene scene;
  for (const Placed& object : subject.objects)
    scene.add(subject.bodies[object.body].shape, object.pose);
  scene.commit();
  return scene;
}

}  // namespace bench
