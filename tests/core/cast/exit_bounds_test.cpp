// SPDX-License-Identifier: MIT
// The bounds of exits: the shape reaches t_lo, and nothing of it lies behind t_hi.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/shape_bounds.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/sample_shapes.h"

namespace minkray {
namespace {

TEST(ExitBounds, hold_by_support_points_of_all_kinds_of_shapes) {
  int exits = 0, with_lower = 0, same = 0;
  for (const testing::SampleShape& sample : testing::sample_shapes()) {
    const PreparedShape prepared(sample.shape);
    const Bounds<double> bounds = bounds_of(sample.shape);
    const double size = bounds.half_extents().norm() + bounds.centre().norm();
    if (!(size > 1e-6 && size < 1e6)) continue;
    testing::AimedRays rays(bounds, 17);
    const double spread = rays.spread_for_half(
        [&](const Ray<double>& ray) { return cast_ray(prepared, ray).found(); });
    testing::Random random(18);
    for (int i = 0; i < testing::number_of_cases(60); ++i) {
      const Ray<double> ray = rays.next(spread);
      const CastResult<double> exit = cast_exit_within(prepared, ray);
      ASSERT_NE(exit.status, Status::exhausted) << sample.name;
      if (exit.status != Status::hit) continue;
      ++exits;
      EXPECT_EQ(exit.t(), cast_exit(prepared, ray).t());
      EXPECT_LE(exit.offset_lo, exit.t_offset) << sample.name;
      EXPECT_GE(exit.offset_hi, exit.t_offset) << sample.name;
      const double t_lo = exit.t_base + exit.offset_lo, t_hi = exit.t_base + exit.offset_hi;
      // A plane separates what is behind t_hi. Rounding of its offset, over the plane's slope.
      const double rounding = 1e-13 * (size + ray.origin.norm() + ray.direction.norm() * t_hi);
      const Vec3<double>& n = exit.normal;
      const double slope = n.dot(ray.direction);
      ASSERT_GT(slope, 0) << sample.name;
      EXPECT_GE(n.dot(ray.origin) + slope * t_hi - n.dot(sample.shape.support(n)), -rounding)
          << sample.name;
      if (std::isinf(t_lo)) continue;
      ++with_lower;
      same += exit.offset_hi - exit.offset_lo < 1e-9 * (1 + std::abs(exit.t())) ? 1 : 0;
      // No plane separates the point at t_lo.
      for (int k = 0; k < 40; ++k) {
        const Vec3<double> m = k == 0   ? n
                               : k < 20 ? unit<double>(n + 0.1 * random.direction())
                                        : random.direction();
        EXPECT_LE(m.dot(ray.at(t_lo)) - m.dot(sample.shape.support(m)), rounding) << sample.name;
      }
    }
  }
  EXPECT_GT(exits, 500);
  EXPECT_GT(with_lower, exits * 9 / 10);
  EXPECT_GT(same, exits * 8 / 10);
}

}  // namespace
}  // namespace minkray
