// SPDX-License-Identifier: MIT
// What several kinds of work need.
#include "tests/soak/work.h"

namespace soak {

std::vector<mk::Shape> some_shapes() {
  return {
      mk::sphere(0.5),
      mk::ellipsoid({0.5, 0.3, 0.2}),
      mk::box({0.3, 0.2, 0.4}),
      mk::disk(0.5),
      mk::cylinder(0.3, 0.4),
      mk::cut_cylinder(0.3, {-0.4, 0.4, {0.2, 0.1}, {-0.3, 0.2}}),
      mk::cone(0.4, 0.4),
      mk::capsule(0.2, 0.3),
      mk::tapered_capsule(0.3, 0.1, 0.3),
      mk::frustum(0.4, 0.2, 0.3),
      mk::superellipsoid({0.5, 0.4, 0.3}, 3),
      mk::hull({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0.1, 0.1, 0.6}, {0.4, 0.4, 0.3}}),
      mk::triangle({0, 0, 0}, {0.6, 0, 0.1}, {0, 0.5, 0.3}),
      mk::rounded(mk::segment({-0.3, 0, 0}, {0.3, 0.1, 0.2}), 0.1),
      mk::sum(mk::box({0.2, 0.1, 0.2}), mk::ellipsoid({0.2, 0.3, 0.1})),
      mk::difference(mk::cone(0.3, 0.3), mk::cylinder(0.1, 0.2)),
      mk::hull_of({mk::sphere(0.2), mk::translated(mk::disk(0.3), {0, 0, 0.4})}),
      mk::scaled(mk::cone(0.4, 0.4), mk::Vec3{1, 0.5, 1.2}),
      mk::swept(mk::sphere(0.15), {0.4, 0.2, 0.1}),
  };
}

mk::Scene scene_of_shapes() {
  mk::Scene scene;
  int i = 0;
  for (const mk::Shape& shape : some_shapes()) {
    const double x = i % 5 - 2, y = i / 5 - 2;
    scene.add(shape, mk::pose({x, y, 0.1 * i}, {0.1 * i, 0.3, -0.2, 0.9}));
    ++i;
  }
  scene.add_half_space({0.1, 0, 1}, -1, "ground");
  scene.commit();
  return scene;
}

std::string source_file(const std::string& name) {
  return MINKRAY_SOURCE_FOLDER "/" + name;
}

bool stopped_after(double part, int threads, const std::function<void(const mk::Options&)>& call) {
  struct Watch {
    double part;
    bool asked;
  } watch = {part, false};
  mk::Options options;
  options.threads = threads;
  options.user = &watch;
  options.progress = [](void* user, double done) {
    auto& watching = *static_cast<Watch*>(user);
    if (done >= watching.part) watching.asked = true;
    return watching.asked ? 1 : 0;
  };
  bool stopped = false;
  try {
    call(options);
  } catch (const mk::Error& error) {
    if (error.code() != MINKRAY_STOPPED) throw;
    stopped = true;
  }
  expect(stopped == watch.asked, "a call must end as stopped if and only if it was asked to");
  return stopped;
}

}  // namespace soak
