// SPDX-License-Identifier: MIT
// The sum of a box and an ellipsoid, and the rounded box that it is: the same points.
#include "core/derived/as_rounded_box.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using S = Shape;

S sum(S a, S b) {
  return MinkowskiSum{{std::move(a), std::move(b)}};
}

void check_same_points() {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> h(random.uniform(0, 2), i % 7 ? random.uniform(0, 2) : 0, random.uniform());
    const Vec3<double> radii(random.uniform(0.3, 1), random.uniform(0.3, 1), 0.5);
    const S box = Box{h}, egg = Ellipsoid{radii};
    const Shape shape = i % 2 ? sum(box, egg) : sum(egg, box);
    const std::optional<Shape> rounded = as_rounded_box(shape);
    ASSERT_TRUE(rounded);
    for (int k = 0; k < 20; ++k) {
      const Vec3<double> n = random.direction();
      EXPECT_LE((rounded->support(n) - shape.support(n)).norm(),
                16.0 * std::numeric_limits<double>::epsilon());
    }
  }
}

TEST(AsRoundedBox, has_the_same_support_points) {
  check_same_points();
}

TEST(AsRoundedBox, of_a_box_and_a_ball_needs_no_map) {
  const std::optional<S> rounded = as_rounded_box(sum(S(Sphere{0.3}), S(Box{{1, 2, 3}})));
  ASSERT_TRUE(rounded);
  const auto* kind = std::get_if<Rounded>(&rounded->kind);
  ASSERT_TRUE(kind);
  EXPECT_EQ(kind->radius, 0.3);
  EXPECT_EQ(std::get<Box>(kind->shape->kind).half_extents, Vec3<double>(1, 2, 3));
}

TEST(AsRoundedBox, leaves_all_others_as_they_are) {
  const S box = Box{{1, 1, 1}}, egg = Ellipsoid{{1, 0.5, 0.3}};
  const S turned = Transform{box, Affine<double>{Random(3).rotation(), Vec3<double>(0, 0, 0)}};
  EXPECT_FALSE(as_rounded_box(box));
  EXPECT_FALSE(as_rounded_box(sum(box, box)));
  EXPECT_FALSE(as_rounded_box(sum(egg, egg)));
  EXPECT_FALSE(as_rounded_box(sum(turned, egg)));
  EXPECT_FALSE(as_rounded_box(S(MinkowskiSum{{box, egg, box}})));
  EXPECT_FALSE(as_rounded_box(S(MinkowskiSum{{box}})));
  EXPECT_FALSE(as_rounded_box(sum(box, S(Ellipsoid{{1, 0.5, 0.2}})))) << "too slender";
  EXPECT_FALSE(as_rounded_box(sum(box, S(Ellipsoid{{1e-9, 2e-9, 1e-9}})))) << "too small";
  EXPECT_FALSE(as_rounded_box(sum(S(Box{{1e9, 1, 1}}), egg))) << "too large";
}

}  // namespace
}  // namespace minkray::testing
