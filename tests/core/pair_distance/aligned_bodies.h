// SPDX-License-Identifier: MIT
// Bodies as people place them: upright, on a grid, turned by right angles, with sizes that are
// multiples of one length.
#pragma once

#include "tests/core/pair_distance/random_bodies.h"

namespace minkray::testing {

inline constexpr double unit_length = 0.25;

inline double on_grid(RandomShapes& random) {
  return unit_length * std::floor(random.in(-4, 5));
}

inline Vec3<double> grid_point(RandomShapes& random) {
  const double x = on_grid(random), y = on_grid(random), z = on_grid(random);
  return {x, y, z};
}

inline constexpr int kinds_of_aligned_bodies = 9;

inline Shape aligned_shape(int kind, RandomShapes& random) {
  const auto size = [&] { return unit_length * std::floor(random.in(1, 5)); };
  const double x = size(), y = size(), z = size(), radius = size();
  switch (kind % kinds_of_aligned_bodies) {
    case 0:
      return Box{{x, y, z}};
    case 1:
      return Cylinder{x, y};
    case 2:
      return Cone{x, y};
    case 3:
      return Sphere{x};
    case 4:
      return Capsule{x, y};
    case 5:
      return Ellipsoid{{x, y, z}};
    case 6:
      return Frustum{{x, y}, z};
    case 7:
      return Rounded{radius, Nested(Shape(Box{{x, y, z}}))};
    default: {
      std::vector<Vec3<double>> points;
      for (int i = 0; i < 10; ++i) points.push_back(grid_point(random));
      return Hull{PointCloud(points)};
    }
  }
}

inline Mat3<double> right_angle(RandomShapes& random) {
  const double half = std::sqrt(0.5);
  switch (static_cast<int>(random.in(0, 6))) {
    case 0:
      return rotation_matrix(half, 0.0, 0.0, half);
    case 1:
      return rotation_matrix(0.0, half, 0.0, half);
    case 2:
      return rotation_matrix(0.0, 0.0, half, half + 1);
    default:
      return Mat3<double>::Identity();
  }
}

}  // namespace minkray::testing
