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

}  // namespace
}  // namespace minkray
