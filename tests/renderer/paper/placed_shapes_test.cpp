// SPDX-License-Identifier: MIT
// Shapes that were scaled, moved, turned and placed: distances and casts are of where they are now.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/distance.h"
#include "renderer/paper/shape_cast.h"
#include "tests/support/mapped.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;

// The maps around a shape were left out of its place in the world.
TEST(Distance, of_balls_that_are_scaled_and_moved_has_its_closed_form) {
  Random random(31);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    // Each ball is scaled and moved, turned around the world's origin, and placed: three maps.
    struct Ball {
      CentredShape shape;
      V centre;
      double radius;
    };
    const auto ball = [&]() -> Ball {
      const double scale = 0.5 + random.uniform(), radius = 0.5 + random.uniform();
      const V shift = 2 * random.in_cube(), place = 3 * random.in_cube();
      const Mat3<double> turn = random.rotation();
      const Affine<double> first{scale * Mat3<double>::Identity(), shift};
      const Affine<double> second{turn, V::Zero()};
      return {centred(mapped(mapped(Sphere{radius}, first), second), moved(place)),
              V(turn * shift + place), scale * radius};
    };
    const Ball a = ball(), b = ball();
    const double gap = (a.centre - b.centre).norm() - a.radius - b.radius;
    const DistanceResult<double, 3> result = distance_between(a.shape, b.shape);
    EXPECT_NEAR(result.distance, std::max(gap, 0.0), 1e-13);
    apart += gap > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 50);
  EXPECT_LT(apart, 190);
}

// The middle of two neighbouring numbers is rounded to one of them: the ball around it that holds
// both is twice as large as that around half of the way between them.
TEST(RayCast, meets_a_capsule_one_rounding_long_far_from_its_origin_at_its_end) {
  const double step = 0x1p-32, low = 0x1p20 + step, high = low + step, radius = step / 4;
  const PreparedShape capsule(
      Shape(Rounded{radius, Nested(Shape(Segment{{V(low, 0, 0), V(high, 0, 0)}}))}));
  const auto expect_hit = [&](const V& from, const V& direction) {
    const CastResult<double> result = cast_ray(capsule, {from, direction});
    ASSERT_EQ(result.status, Status::hit) << direction.transpose();
    EXPECT_NEAR(result.t(), 1 - radius, 1e-14) << direction.transpose();
  };
  expect_hit({low - 1, 0, 0}, {1, 0, 0});
  expect_hit({high + 1, 0, 0}, {-1, 0, 0});
  for (const double x : {low, high}) expect_hit({x, 0, 1}, {0, 0, -1});
}

// The new place of the first shape was forgotten.
TEST(ShapeCast, begins_where_both_shapes_were_put) {
  PreparedPair pair(centred(Sphere{1}), centred(Sphere{2}));
  pair.place({-3, 5, 1}, {4, 5, 1});
  const ShapeCastResult result = cast_shape(pair, V(-2, 0, 0));
  ASSERT_EQ(result.cast.status, Status::hit);
  EXPECT_NEAR(result.cast.t(), 2, 1e-14);
  EXPECT_LE((result.point_a - V(-2, 5, 1)).norm(), 1e-13);
  EXPECT_LE((result.point_b - V(-2, 5, 1)).norm(), 1e-13);
}

}  // namespace
}  // namespace minkray::testing
