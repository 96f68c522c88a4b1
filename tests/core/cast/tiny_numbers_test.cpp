// SPDX-License-Identifier: MIT
// Rays whose numbers are so small that their squares are 0, or that what is divided by them leaves
// the number range.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/solvers.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

void check_ends() {
  const double tiny = double(1e-200);
  ASSERT_EQ(tiny * tiny, 0.0);
  const Vec3<double> x(tiny, 0, 0);
  const PreparedShape point{Shape(Point{})};
  for (const auto& solver : named_solvers) {
    SCOPED_TRACE(std::string(solver.name));
    const CastOptions options{solver.kind};
    const CastResult<double> behind = cast_ray(point, Ray<double>{3 * x, x}, options);
    EXPECT_EQ(name_of(behind.status), name_of(Status::miss));
    EXPECT_GT(behind.normal.x(), 0.9);  // from the point towards the ray
    const CastResult<double> before = cast_ray(point, Ray<double>{-4 * x, x, 3.0}, options);
    EXPECT_EQ(name_of(before.status), name_of(Status::miss));
    EXPECT_LT(before.normal.x(), double(-0.9));
    EXPECT_EQ(name_of(cast_ray(point, Ray<double>{-4 * x, x, 5.0}, options).status),
              name_of(Status::hit));
  }
}

TEST(TinyNumbers, a_ray_may_end_so_near_a_point_that_the_way_has_no_square) {
  check_ends();
}

/// Shapes on different paths: closed forms, planes, models and GJK.
std::vector<Shape> reached() {
  const auto nested = [](const Shape& shape) { return Nested(shape); };
  const Shape box = Box{{1, 2, 3}}, egg = Ellipsoid{{1, 2, 3}};
  return {Sphere{1},
          box,
          egg,
          Superellipsoid{{1, 2, 3}, 3},
          Rounded{0.5, nested(box)},
          MinkowskiSum{{nested(box), nested(egg)}},
          HullOf{{nested(egg), nested(Point{{0, 0, 5}})}}};
}

void check_no_time() {
  const double least = std::numeric_limits<double>::denorm_min();
  for (const Shape& wanted : reached()) {
    const PreparedShape shape(wanted);
    for (const auto& solver : named_solvers) {
      const Ray<double> ray{{-64, 0, 0}, {8 * least, 0, 0}};
      const CastResult<double> answer = cast_ray(shape, ray, {solver.kind});
      EXPECT_EQ(name_of(answer.status), name_of(Status::exhausted))
          << name_of_nesting(wanted) << " by " << solver.name << " at " << answer.t();
    }
  }
}

TEST(TinyNumbers, of_what_a_ray_reaches_when_no_number_can_tell_nothing_is_said) {
  check_no_time();
}

}  // namespace
}  // namespace minkray::testing
