// SPDX-License-Identifier: MIT
// Shapes and a scene for what sees nothing but the library's public headers.
#pragma once

#include <minkray/minkray.h>

#include <vector>

/// One new shape of every kind, and some of the algebra.
inline std::vector<minkray::Shape> some_shapes() {
  return {
      minkray::sphere(0.5),
      minkray::ellipsoid({0.5, 0.3, 0.2}),
      minkray::box({0.3, 0.2, 0.4}),
      minkray::disk(0.5),
      minkray::cylinder(0.3, 0.4),
      minkray::cut_cylinder(0.3, {-0.4, 0.4, {0.2, 0.1}, {-0.3, 0.2}}),
      minkray::cone(0.4, 0.4),
      minkray::capsule(0.2, 0.3),
      minkray::tapered_capsule(0.3, 0.1, 0.3),
      minkray::frustum(0.4, 0.2, 0.3),
      minkray::superellipsoid({0.5, 0.4, 0.3}, 3),
      minkray::hull({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0.1, 0.1, 0.6}, {0.4, 0.4, 0.3}}),
      minkray::triangle({0, 0, 0}, {0.6, 0, 0.1}, {0, 0.5, 0.3}),
      minkray::rounded(minkray::segment({-0.3, 0, 0}, {0.3, 0.1, 0.2}), 0.1),
      minkray::sum(minkray::box({0.2, 0.1, 0.2}), minkray::ellipsoid({0.2, 0.3, 0.1})),
      minkray::difference(minkray::cone(0.3, 0.3), minkray::cylinder(0.1, 0.2)),
      minkray::hull_of(
          {minkray::sphere(0.2), minkray::translated(minkray::disk(0.3), {0, 0, 0.4})}),
      minkray::scaled(minkray::cone(0.4, 0.4), minkray::Vec3{1, 0.5, 1.2}),
      minkray::swept(minkray::sphere(0.15), {0.4, 0.2, 0.1}),
  };
}

/// Those in rows on the ground; committed.
inline minkray::Scene scene_of_shapes() {
  minkray::Scene scene;
  int i = 0;
  for (const minkray::Shape& shape : some_shapes()) {
    const double x = i % 5 - 2, y = i / 5 - 2;
    scene.add(shape, minkray::pose({x, y, 0.1 * i}, {0.1 * i, 0.3, -0.2, 0.9}));
    ++i;
  }
  scene.add_half_space({0.1, 0, 1}, -1, "ground");
  scene.commit();
  return scene;
}
