// SPDX-License-Identifier: MIT
// Worlds of shapes here and there, rays of several kinds at them, and whether two answers are the
// same, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "core/world/world.h"

namespace minkray::testing {

template <class T>
struct Scatter {
  std::mt19937 generator{5};
  T within(T low, T high) { return std::uniform_real_distribution<T>(low, high)(generator); }
  Vec3<T> point(T size) { return {within(-size, size), within(-size, size), within(-size, size)}; }
  Affine<T> pose(T size) {
    const Vec3<T> axis = point(1);
    return {rotation_matrix(axis.x(), axis.y(), axis.z(), within(-1, 1)), point(size)};
  }
};

/// Shapes have models for packets or none; some stand in the same place twice.
template <class T>
Instances<T> scattered_shapes(int count, Scatter<T>& random) {
  const std::vector<Shape<T>> kinds = {
      Sphere<T>{T(0.7)},
      Rounded<T>{T(0.1), Shape<T>(Box<T>{{T(0.6), T(0.5), T(0.3)}})},
      Ellipsoid<T>{{T(1), T(0.5), T(0.2)}},
      Cylinder<T>{T(0.3), T(0.8)},
      MinkowskiSum<T>{{Shape<T>(Ellipsoid<T>{{T(0.4), T(0.3), T(0.2)}}),
                       Shape<T>(Box<T>{{T(0.3), T(0.3), T(0.1)}})}},
      Triangle<T>{{Vec3<T>(0, 0, 0), Vec3<T>(1, 0, 0), Vec3<T>(0, 1, 0)}}};
  Instances<T> shapes;
  for (int i = 0; i < count; ++i) {
    const Shape<T>& kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const Affine<T> pose = random.pose(6);
    for (int twice = 0; twice < (i % 10 == 0 ? 2 : 1); ++twice) shapes.add(kind, pose);
  }
  return shapes;
}

/// A few definitions of many instances, some of which are moved only.
template <class T>
Instances<T> scattered_instances(int count, Scatter<T>& random) {
  const Shape<T> box = Box<T>{{T(0.6), T(0.5), T(0.3)}};
  std::vector<Vec3<T>> points;
  for (int i = 0; i < 20; ++i) points.push_back(random.point(T(0.8)));
  const Shape<T> hull = Hull<T>{PointCloud<T>(points)};
  const std::vector<Shape<T>> kinds = {
      Sphere<T>{T(0.7)},
      box,
      Rounded<T>{T(0.1), box},
      Ellipsoid<T>{{T(1), T(0.5), T(0.2)}},
      Cylinder<T>{T(0.3), T(0.8)},
      Cone<T>{T(0.5), T(0.8)},
      Capsule<T>{T(0.3), T(0.8)},
      hull,
      Rounded<T>{T(0.1), hull},
      Rounded<T>{T(0.2), Shape<T>(Segment<T>{{Vec3<T>(0, 0, 0), Vec3<T>(1, 1, 0)}})},
      MinkowskiSum<T>{{Shape<T>(Ellipsoid<T>{{T(0.4), T(0.3), T(0.2)}}),
                       Shape<T>(Box<T>{{T(0.3), T(0.3), T(0.1)}})}},
      Triangle<T>{{Vec3<T>(0, 0, 0), Vec3<T>(1, 0, 0), Vec3<T>(0, 1, 0)}}};
  Instances<T> shapes;
  for (const Shape<T>& kind : kinds) shapes.define(kind);
  for (int i = 0; i < count; ++i) {
    Affine<T> pose = random.pose(12);
    if (i % 3 == 0) pose.linear = Mat3<T>::Identity();
    if (i % 7 == 0) pose.linear.col(1) *= T(1.5);
    shapes.add(static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(kinds.size()), pose);
  }
  return shapes;
}

/// Rays as a camera's, as towards a far light, or as they come.
template <class T>
std::vector<WorldRay<T>> bundle(Scatter<T>& random, int kind, std::size_t count,
                                std::size_t instances) {
  const Vec3<T> from = random.point(12), towards = random.point(5) - from;
  std::vector<WorldRay<T>> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Ray<T> ray{from, towards + random.point(T(0.3))};
    if (kind == 1) ray = {from + random.point(1), towards};
    if (kind == 2) ray = {random.point(7), random.point(1)};
    if (i % 5 == 0) ray.t_max = random.within(T(0.3), T(1.2));
    const auto skip = static_cast<std::uint32_t>(random.within(0, static_cast<T>(instances)));
    rays.push_back({ray, i % 4 == 0 ? skip : no_instance});
  }
  return rays;
}

template <class T>
::testing::AssertionResult same(const WorldHit<T>& a, const WorldHit<T>& b) {
  const CastResult<T>&x = a.cast, &y = b.cast;
  if (a.instance != b.instance)
    return ::testing::AssertionFailure()
           << a.instance << " and " << b.instance << " at " << x.t() << " and " << y.t();
  if (x.status != y.status) return ::testing::AssertionFailure() << "status";
  if (!a.found()) return ::testing::AssertionSuccess();
  if (x.t_base != y.t_base || x.t_offset != y.t_offset || x.offset_lo != y.offset_lo ||
      x.offset_hi != y.offset_hi)
    return ::testing::AssertionFailure() << "t " << x.t() << " and " << y.t();
  if (x.normal != y.normal) return ::testing::AssertionFailure() << "normal";
  return ::testing::AssertionSuccess();
}

}  // namespace minkray::testing
