// SPDX-License-Identifier: MIT
// Results where nothing could be proven, and the rounding that proofs are allowed.
#include "core/cast/judge.h"

#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/proof/proven_cast.h"

namespace minkray::testing {
namespace {

// The line passes the box by: no proof of a hit holds.
TEST(Judge, an_unproven_answer_at_an_ordinary_shape_is_given_where_there_is_none_better) {
  const PreparedShape box(Shape(Box{{1, 1, 1}}));
  const RayNearBall<double> near = box.to_inner(Ray<double>{{-3, 1.001, 0}, {1, 0, 0}});
  const CastOptions options;
  const CastObserver observer;
  const StageQuestion question{box, near, options, observer};
  CastResult<double> touches;
  touches.status = Status::hit;
  touches.t_base = near.t_base;
  touches.t_offset = touches.offset_lo = touches.offset_hi = -1;
  touches.normal = {0, 1, 0};
  for (const Proof proof : {Proof::none, Proof::steep_hits, Proof::all}) {
    Judge judge(question, proof);
    EXPECT_EQ(judge.accepts(touches), proof == Proof::none);
    const CastResult<double> verdict = judge.verdict();
    EXPECT_EQ(verdict.status, proof == Proof::all ? Status::exhausted : Status::hit);
    EXPECT_EQ(verdict.t_offset, -1);
  }
}

// The middle of a sliver is only known to sixteen times the rounding of its corners; what is
// further off is no hit.
TEST(Judge, hits_are_proven_that_are_off_by_less_than_sixteen_times_a_checkers_rounding) {
  const PreparedShape ball(Shape(Sphere{2}));
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};
  const RayNearBall<double> near = ball.to_inner(ray);
  const double rounding = 2 * std::numeric_limits<double>::epsilon();  // of the radius
  for (const double roundings : {-160.0, 0.0, 160.0, 3200.0, 1e6}) {
    CastResult<double> answer = cast_ray(ball, ray);
    answer.t_offset += roundings * rounding;
    EXPECT_EQ(proven(ball.inner_shape(), ball.inner_ball(), near, answer).holds,
              std::abs(roundings) < 1000)
        << roundings;
  }
}

// The ray leaves the shape, or would enter it, along its surface: at shapes with corners an origin
// inside is checked again.
TEST(Judge, origins_just_inside_smooth_shapes_are_told_by_models) {
  const CastOptions options{&solver::jet};
  const Shape kinds[] = {
      Superellipsoid{{1, 0.8, 0.6}, 2.5},
      MinkowskiSum{{Shape(Ellipsoid{{1, 0.8, 0.2}}), Shape(Ellipsoid{{0.3, 0.5, 0.4}})}}};
  for (const Shape& kind : kinds) {
    const PreparedShape shape(kind);
    for (const double depth : {1e-9, 1e-8, 1e-3, 0.2}) {
      const CastResult<double> answer =
          cast_ray(shape, Ray<double>{{0, 0, 0.6 - depth}, {1, 0, 0}}, options);
      EXPECT_EQ(answer.status, Status::inside) << depth;
      EXPECT_EQ(name_of(answer.path), name_of(Path::model)) << depth;
    }
  }
}

}  // namespace
}  // namespace minkray::testing
