// SPDX-License-Identifier: MIT
// Rays within some roundings of a shape's bounding ball are given no answer that is none.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/solvers.h"

namespace minkray::testing {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(TouchedBalls, rays_that_begin_at_a_surface_do_not_hit_it_where_they_begin) {
  const PreparedShape ball(Shape(Sphere{1}));
  for (const Solver* const solver : {&solver::gjk_alone, &solver::first_solution}) {
    const CastOptions options{solver};
    for (int roundings = -8; roundings <= 12; ++roundings) {
      const Ray<double> ray{{1 + roundings * epsilon, 0, 0}, {0, 1, 0}};
      const CastResult<double> answer = cast_ray(ball, ray, options);
      EXPECT_NE(name_of(answer.status), name_of(Status::hit)) << roundings;
    }
  }
}

// A miss is a claim: a plane between ray and shape.
TEST(TouchedBalls, rays_through_a_ball_do_not_miss_it_however_short_the_way) {
  const PreparedShape ball(Shape(Sphere{1}));
  for (const Solver* const solver : {&solver::automatic, &solver::jet, &solver::portal,
                                     &solver::gjk_alone, &solver::first_solution}) {
    const CastOptions options{solver};
    for (int roundings = 1; roundings <= 30; ++roundings) {
      const Ray<double> ray{{-3, 1 - roundings * epsilon, 0}, {1, 0, 0}};
      const CastResult<double> answer = cast_ray(ball, ray, options);
      EXPECT_NE(name_of(answer.status), name_of(Status::miss))
          << name_in(named_solvers, solver) << " " << roundings;
    }
  }
}

}  // namespace
}  // namespace minkray::testing
