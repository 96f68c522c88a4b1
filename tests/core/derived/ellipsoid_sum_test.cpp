// SPDX-License-Identifier: MIT
// Parts of shapes lie in the shapes and touch their supporting planes.
#include "core/derived/ellipsoid_sum.h"

#include <gtest/gtest.h>

#include "core/derived/shape_bounds.h"
#include "tests/support/random.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

/// Roundings of a sum of a few numbers of the shape's size, as far from the origin as it may be.
double rounding_of(const Shape& shape) {
  const Ball<double> ball = ball_around(bounds_of(shape));
  return 16.0 * std::numeric_limits<double>::epsilon() * (ball.radius + ball.centre.norm());
}

void check(const Shape& sample, std::string_view name) {
  const double rounding = rounding_of(sample);
  Random random(29);
  for (int i = 0; i < 40; ++i) {
    Vec3<double> n = random.direction();
    if (i % 4 == 0) n[i / 4 % 3] = 0.0;
    if (i % 8 == 0) n[(i / 4 + 1) % 3] = 0.0;
    n.normalize();
    const EllipsoidSum<double> part = touching_sum<double>(sample, n);
    const Vec3<double> support = sample.support(n);
    ASSERT_NEAR(n.dot(part.s), n.dot(support), rounding) << name;
    ASSERT_NEAR(part.support_function(n), n.dot(support), rounding) << name;
    if (!part.exact) continue;
    for (int j = 0; j < 40; ++j) {
      const Vec3<double> m = random.direction();
      ASSERT_LE(part.support_function(m), m.dot(sample.support(m)) + rounding) << name;
    }
  }
}

TEST(EllipsoidSum, is_a_part_of_the_shape) {
  for (const SampleShape& sample : sample_shapes()) {
    check(sample.shape, sample.name);
  }
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Shape shape = random_nesting(seed, 1 + static_cast<int>(seed % 4));
    check(shape, name_of_nesting(shape));
  }
}

TEST(EllipsoidSum, of_balls_is_a_ball) {
  const Shape capsule = Capsule{0.5, 1}, sphere = Sphere{0.25};
  const Shape turned =
      Transform{capsule, AffineMap(Affine<double>{Random(4).rotation(), {1, 2, 3}})};
  const Shape sum = Rounded{0.125, Shape(MinkowskiSum{{capsule, turned, sphere}})};
  const EllipsoidSum<double> part = touching_sum<double>(sum, Vec3<double>(0.6, 0, 0.8));
  EXPECT_TRUE(part.exact);
  EXPECT_EQ(part.used, 1u);
  EXPECT_NEAR(part.F[0].trace(), 3 * 1.375, 1e-14);
}

TEST(EllipsoidSum, of_more_than_it_can_hold_osculates) {
  const Shape egg = Ellipsoid{{1, 0.5, 0.25}};
  std::vector<Nested> eggs;
  for (std::uint64_t i = 0; i <= EllipsoidSum<double>::most; ++i)
    eggs.emplace_back(
        Shape(Transform{egg, AffineMap(Affine<double>{Random(i).rotation(), {0, 0, 0}})}));
  const Shape sum = MinkowskiSum{eggs};
  const Vec3<double> n = Vec3<double>(1, 2, 3).normalized();
  const EllipsoidSum<double> part = touching_sum<double>(sum, n);
  EXPECT_FALSE(part.exact);
  EXPECT_NEAR(part.support_function(n), n.dot(sum.support(n)), 1e-14);
  EXPECT_FALSE(has_exact_sums(sum));
  eggs.pop_back();
  EXPECT_TRUE(has_exact_sums(Shape(MinkowskiSum{eggs})));
}

}  // namespace
}  // namespace minkray::testing
