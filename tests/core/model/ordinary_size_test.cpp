// SPDX-License-Identifier: MIT
// Shapes so large or so small that products of their lengths would leave the numbers' range are
// brought to about unit size, which no result shows; others are cast at as they are.
#include <gtest/gtest.h>

#include "core/cast/cast.h"

namespace minkray::testing {
namespace {

Shape of_size(double size) {
  return Superellipsoid{{size, size * 0.75, size * 0.5}, 3.0};
}

/// Casts a ray from a distance of that many sizes.
CastResult<double> cast_at(const PreparedShape& shape, double size) {
  return cast_ray(shape, Ray<double>{Vec3<double>(-3.0, 0.25, 0.125) * size, {size, 0.0, 0.0}});
}

void check(double limit) {
  const CastResult<double> ordinary = cast_at(PreparedShape(of_size(1.0)), 1.0);
  ASSERT_EQ(ordinary.status, Status::hit);
  for (const double share : {1e-3, 0.9, 1.1, 5.0, 1e3})
    for (const bool is_large : {true, false}) {
      const double size = is_large ? limit * double(share) : 1 / (limit * double(share));
      const PreparedShape shape(of_size(size));
      const double seen = shape.definition().inner_half_extents().maxCoeff();
      if (share < 1) {
        EXPECT_NEAR(double(seen / size), 1, 1e-5) << size;
      } else {
        EXPECT_GE(seen, 0.99) << size;
        EXPECT_LE(seen, 2.01) << size;
      }
      const CastResult<double> answer = cast_at(shape, size);
      ASSERT_EQ(answer.status, Status::hit) << size;
      EXPECT_NEAR(double(answer.t()), double(ordinary.t()), 1e-5) << size;
    }
}

TEST(OrdinarySize, shapes_beyond_it_are_cast_at_in_about_unit_size) {
  check(0x1p128);
}

}  // namespace
}  // namespace minkray::testing
