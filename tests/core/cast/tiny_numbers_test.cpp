// SPDX-License-Identifier: MIT
// Rays whose numbers are so small that their squares are 0, or that what is divided by them leaves
// the number range.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/convert.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

template <class T>
void check_ends() {
  const T tiny = std::is_same_v<T, float> ? T(1e-30) : T(1e-200);
  ASSERT_EQ(tiny * tiny, T(0));
  const Vec3<T> x(tiny, 0, 0);
  const PreparedShape<T> point{Shape<T>(Point<T>{})};
  for (const SolverDescription& solver : solver_descriptions) {
    SCOPED_TRACE(std::string(solver.name));
    const CastOptions<T> options{solver.kind};
    const CastResult<T> behind = cast_ray(point, Ray<T>{3 * x, x}, options);
    EXPECT_EQ(name_of(behind.status), name_of(Status::miss));
    EXPECT_GT(behind.normal.x(), T(0.9));  // from the point towards the ray
    const CastResult<T> before = cast_ray(point, Ray<T>{-4 * x, x, T(3)}, options);
    EXPECT_EQ(name_of(before.status), name_of(Status::miss));
    EXPECT_LT(before.normal.x(), T(-0.9));
    EXPECT_EQ(name_of(cast_ray(point, Ray<T>{-4 * x, x, T(5)}, options).status),
              name_of(Status::hit));
  }
}

TEST(TinyNumbers, a_ray_may_end_so_near_a_point_that_the_way_has_no_square) {
  check_ends<float>();
  check_ends<double>();
}

/// Shapes on different paths: closed forms, planes, models and GJK.
std::vector<Shape<double>> reached() {
  const auto nested = [](const Shape<double>& shape) { return Nested<double>(shape); };
  const Shape<double> box = Box<double>{{1, 2, 3}}, egg = Ellipsoid<double>{{1, 2, 3}};
  return {Sphere<double>{1},
          box,
          egg,
          Superellipsoid<double>{{1, 2, 3}, 3},
          Rounded<double>{0.5, nested(box)},
          MinkowskiSum<double>{{nested(box), nested(egg)}},
          HullOf<double>{{nested(egg), nested(Point<double>{{0, 0, 5}})}}};
}

template <class T>
void check_no_time() {
  const T least = std::numeric_limits<T>::denorm_min();
  for (const Shape<double>& wanted : reached()) {
    const PreparedShape<T> shape(convert<T>(wanted));
    for (const SolverDescription& solver : solver_descriptions) {
      const Ray<T> ray{{-64, 0, 0}, {8 * least, 0, 0}};
      const CastResult<T> answer = cast_ray(shape, ray, {solver.kind});
      EXPECT_EQ(name_of(answer.status), name_of(Status::exhausted))
          << name_of_nesting(wanted) << " by " << solver.name << " at " << answer.t();
    }
  }
}

TEST(TinyNumbers, of_what_a_ray_reaches_when_no_number_can_tell_nothing_is_said) {
  check_no_time<float>();
  check_no_time<double>();
}

}  // namespace
}  // namespace minkray::testing
