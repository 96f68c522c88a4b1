// SPDX-License-Identifier: MIT
#include "core/solver/cast.h"

#include <gtest/gtest.h>

namespace minkray {
namespace {

TEST(Cast, a_far_origin_costs_no_precision_in_float) {
  const PreparedShape<float> ball(Sphere<float>{1.0f});
  const CastResult<float> near = cast_ray<float>(ball, {{-4, 0.5f, 0}, {1, 0, 0}});
  const CastResult<float> far = cast_ray<float>(ball, {{-262144, 0.5f, 0}, {1, 0, 0}});
  ASSERT_EQ(near.status, Status::hit);
  ASSERT_EQ(far.status, Status::hit);
  EXPECT_NEAR(near.t_offset, -std::sqrt(0.75f), 1e-6f);
  EXPECT_EQ(far.t_offset, near.t_offset);
  EXPECT_EQ(far.t_base, 262144.0f);
}

TEST(Cast, a_ray_from_inside_says_so_and_knows_its_exit) {
  const PreparedShape<double> box(Box<double>{{1, 2, 3}}, {Mat3<double>::Identity(), {10, 0, 0}});
  const Ray<double> ray{{10, 0, 0}, {0, 0.5, 0}};
  EXPECT_EQ(cast_ray(box, ray).status, Status::inside);
  EXPECT_EQ(cast_ray(box, ray).t(), 0.0);
  const CastResult<double> exit = cast_exit(box, ray);
  ASSERT_EQ(exit.status, Status::hit);
  EXPECT_NEAR(exit.t(), 4.0, 1e-14);
  EXPECT_NEAR(exit.normal.y(), 1.0, 1e-14);
}

/// A ball of 1e-30 was once "hit" at its centre, t = 5 with t_lo = 5: squares had underflowed.
TEST(Cast, scales_near_the_ends_of_the_number_range_are_answered_like_any_other) {
  for (const float scale : {1e-30f, 1e-15f, 1e-5f, 1e5f, 1e15f, 1e30f}) {
    const PreparedShape<float> ball(Sphere<float>{scale}), box(Box<float>{{scale, scale, scale}});
    for (const SolverKind kind : {SolverKind::automatic, SolverKind::jet, SolverKind::paper}) {
      const Ray<float> ray{{-5 * scale, 0, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray<float>(ball, ray, {kind}).status, Status::hit) << scale;
      EXPECT_NEAR(cast_ray<float>(ball, ray, {kind}).t(), 4, 1e-5) << scale;
      EXPECT_NEAR(cast_ray<float>(box, ray, {kind}).t(), 4, 1e-5) << scale;
      const Ray<float> beside{{-5 * scale, 1.5f * scale, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray<float>(ball, beside, {kind}).status, Status::miss) << scale;
    }
  }
}

}  // namespace
}  // namespace minkray
