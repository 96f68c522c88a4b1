// SPDX-License-Identifier: MIT
// Worlds of shapes here and there, and rays of several kinds at them.
#pragma once

#include <random>

#include "tests/support/world_judge.h"

namespace minkray::testing {

struct Scatter {
  std::mt19937 generator{5};
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }
  Vec3<double> point(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }
  Affine<double> pose(double size) {
    const Vec3<double> axis = point(1);
    return {rotation_matrix(axis.x(), axis.y(), axis.z(), within(-1, 1)), point(size)};
  }
};

/// Shapes have models for packets or none; some are in the same place twice.
inline Instances scattered_shapes(int count, Scatter& random) {
  const std::vector<Shape> kinds = {
      Sphere{0.7},
      Rounded{0.1, Shape(Box{{0.6, 0.5, 0.3}})},
      Ellipsoid{{1, 0.5, 0.2}},
      Cylinder{0.3, 0.8},
      MinkowskiSum{{Shape(Ellipsoid{{0.4, 0.3, 0.2}}), Shape(Box{{0.3, 0.3, 0.1}})}},
      Triangle{{Vec3<double>(0, 0, 0), Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0)}}};
  Instances shapes;
  for (int i = 0; i < count; ++i) {
    const Shape& kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const Affine<double> pose = random.pose(6);
    for (int twice = 0; twice < (i % 10 == 0 ? 2 : 1); ++twice) shapes.add(kind, pose);
  }
  return shapes;
}

/// A few definitions of many instances, some of them only moved.
inline Instances scattered_instances(int count, Scatter& random) {
  const Shape box = Box{{0.6, 0.5, 0.3}};
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 20; ++i) points.push_back(random.point(0.8));
  const Shape hull = Hull{PointCloud(points)};
  const std::vector<Shape> kinds = {
      Sphere{0.7},
      box,
      Rounded{0.1, box},
      Ellipsoid{{1, 0.5, 0.2}},
      Cylinder{0.3, 0.8},
      Cone{0.5, 0.8},
      Capsule{0.3, 0.8},
      hull,
      Rounded{0.1, hull},
      Rounded{0.2, Shape(Segment{{Vec3<double>(0, 0, 0), Vec3<double>(1, 1, 0)}})},
      MinkowskiSum{{Shape(Ellipsoid{{0.4, 0.3, 0.2}}), Shape(Box{{0.3, 0.3, 0.1}})}},
      Triangle{{Vec3<double>(0, 0, 0), Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0)}}};
  Instances shapes;
  for (const Shape& kind : kinds) shapes.define(kind);
  for (int i = 0; i < count; ++i) {
    Affine<double> pose = random.pose(12);
    if (i % 3 == 0) pose.linear = Mat3<double>::Identity();
    if (i % 7 == 0) pose.linear.col(1) *= 1.5;
    shapes.add(static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(kinds.size()), pose);
  }
  return shapes;
}

/// Rays as a camera's, as towards a far light, or as they come.
inline std::vector<WorldRay> bundle(Scatter& random, int kind, std::size_t count,
                                    std::size_t instances) {
  const Vec3<double> from = random.point(12), towards = random.point(5) - from;
  std::vector<WorldRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Ray<double> ray{from, towards + random.point(0.3)};
    if (kind == 1) ray = {from + random.point(1), towards};
    if (kind == 2) ray = {random.point(7), random.point(1)};
    if (i % 5 == 0) ray.t_max = random.within(0.3, 1.2);
    const auto skip = static_cast<std::uint32_t>(random.within(0, static_cast<double>(instances)));
    rays.push_back({ray, i % 4 == 0 ? skip : no_instance});
  }
  return rays;
}

}  // namespace minkray::testing
