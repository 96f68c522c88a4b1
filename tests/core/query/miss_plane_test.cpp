// SPDX-License-Identifier: MIT
// A miss is proven by a plane: the shape on one side, all of the ray on the other. Checked with
// one support call only. Previously false for the GJK ray cast: where a ray had been clipped and
// then passed the shape, the reported plane held only for the part ahead, and cut the ray.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/solvers.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

/// Largest distance of a point on the wrong side, relative to the numbers that make up its
/// distance: the roundings of a support point and of a normal.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

class MissPlanes : public ::testing::TestWithParam<SampleShape> {};

TEST_P(MissPlanes, separate_ray_and_shape) {
  const Shape& shape = GetParam().shape;
  const PreparedShape prepared(shape);
  Bounds<double> bounds = prepared.definition().bounds_of(Affine<double>{});
  if (!(bounds.half_extents().maxCoeff() > 0)) {  // a point: rays that pass it by
    const Vec3<double> point = bounds.centre();
    bounds.extend(Vec3<double>(point.array() - 1));
    bounds.extend(Vec3<double>(point.array() + 1));
  }
  const double size = bounds.half_extents().norm() + bounds.centre().norm();
  int misses = 0;
  for (const auto& solver : named_solvers) {
    AimedRays rays(bounds, 77);
    for (int i = 0; i < 300; ++i) {
      Ray<double> ray = rays.next(1.5);
      if (i % 3 == 1) ray.t_max = 0.6;           // ends within or before many shapes
      if (i % 3 == 2) ray.origin = ray.at(0.9);  // begins near the shape
      const CastResult<double> result = cast_ray(prepared, ray, {solver.kind});
      if (result.status != Status::miss) continue;
      ++misses;
      const Vec3<double>& n = result.normal;
      const double height = n.dot(shape.support(n));
      EXPECT_GE(n.dot(ray.origin), height - rounding * (size + ray.origin.norm()))
          << solver.name << " ray " << i;
      if (std::isfinite(ray.t_max)) {
        EXPECT_GE(n.dot(ray.at(ray.t_max)), height - rounding * (size + ray.origin.norm()))
            << solver.name << " ray " << i;
      } else {
        EXPECT_GE(n.dot(ray.direction), -rounding * ray.direction.norm())
            << solver.name << " ray " << i;
      }
    }
  }
  EXPECT_GT(misses, 100);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MissPlanes, values_asked_for<MissPlanes>(sample_shapes),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST(TangentRays, along_a_generator_are_met_where_they_first_touch_or_not_at_all) {
  const PreparedShape cylinder(Cylinder{1, 1});
  const CastResult<double> along = cast_ray(cylinder, {{1, 0, -5}, {0, 0, 1}});
  if (along.status == Status::hit) {
    EXPECT_NEAR(along.t(), 4, 1e-12);
  }
  const PreparedShape capsule(Capsule{0.5, 1});
  const CastResult<double> across = cast_ray(capsule, {{-5, 0.5, -5}, {1, 0, 1}});
  if (across.status == Status::hit) {
    EXPECT_NEAR(across.t(), 5, 1e-6);
  }
  EXPECT_NE(along.status, Status::exhausted);
  EXPECT_NE(across.status, Status::exhausted);
}

}  // namespace
}  // namespace minkray::testing
