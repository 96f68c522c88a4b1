// SPDX-License-Identifier: MIT
// Shapes so large or so small that products of their lengths would leave the numbers' range are
// brought to about unit size, which no result shows; others are cast at as they are.
#include <gtest/gtest.h>

#include "core/cast/cast.h"

namespace minkray::testing {
namespace {

template <class T>
Shape<T> of_size(T size) {
  return Superellipsoid<T>{{size, size * T(0.75), size * T(0.5)}, T(3)};
}

/// Casts a ray from a distance of that many sizes.
template <class T>
CastResult<T> cast_at(const PreparedShape<T>& shape, T size) {
  return cast_ray(shape, Ray<T>{Vec3<T>(T(-3), T(0.25), T(0.125)) * size, {size, T(0), T(0)}});
}

template <class T>
void check(T limit) {
  const CastResult<T> ordinary = cast_at(PreparedShape<T>(of_size(T(1))), T(1));
  ASSERT_EQ(ordinary.status, Status::hit);
  for (const double share : {1e-3, 0.9, 1.1, 5.0, 1e3})
    for (const bool is_large : {true, false}) {
      const T size = is_large ? limit * T(share) : 1 / (limit * T(share));
      const PreparedShape<T> shape(of_size(size));
      const T seen = shape.definition().inner_half_extents().maxCoeff();
      if (share < 1) {
        EXPECT_NEAR(double(seen / size), 1, 1e-5) << size;
      } else {
        EXPECT_GE(seen, T(0.99)) << size;
        EXPECT_LE(seen, T(2.01)) << size;
      }
      const CastResult<T> answer = cast_at(shape, size);
      ASSERT_EQ(answer.status, Status::hit) << size;
      EXPECT_NEAR(double(answer.t()), double(ordinary.t()), 1e-5) << size;
    }
}

TEST(OrdinarySize, shapes_beyond_it_are_cast_at_in_about_unit_size) {
  check<float>(0x1p16f);
  check<double>(0x1p128);
}

}  // namespace
}  // namespace minkray::testing
