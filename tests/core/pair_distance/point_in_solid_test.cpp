// SPDX-License-Identifier: MIT
// Balls whose middle is in a box, a cylinder, a cone or a frustum: whether their depth has one
// direction is compared with the depth after a step along it.
#include <gtest/gtest.h>

#include "core/pair_distance/signed_distance.h"
#include "tests/core/pair_distance/random_numbers.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

TEST(PointInSolid, has_one_direction_only_if_a_step_along_it_is_as_deep_as_long) {
  testing::RandomNumbers random(29);
  int one = 0, several = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto size = [&] { return random.in(0.2, 1); };
    const Shape solids[] = {Box{Vec3<double>(size(), size(), size())}, Cylinder{size(), size()},
                            Cone{size(), size()}, Frustum{{size(), size()}, size()}};
    const Shape& shape = solids[k % 4];
    const double rounding = k % 3 == 0 ? 0.1 : 0.0;
    const ContactShape solid(rounding > 0 ? Shape(Rounded{rounding, Nested(shape)}) : shape),
        ball(Sphere{size()});
    // One in two is near a plane or an axis of symmetry, where the direction changes.
    Vec3<double> at = random.in(0, 0.5) * random.direction();
    if (k % 2 == 0) at = at.cwiseProduct(Vec3<double>(random.in(0, 2e-4), random.in(0, 2e-4), 1));
    const Mat3<double> turn = random.turn();
    const Affine<double> pose_a{turn, Vec3<double>::Zero()};
    const auto depth_at = [&](const Vec3<double>& place) {
      return signed_distance(solid, pose_a, ball, shifted_by(place));
    };
    const SignedDistance found = depth_at(turn * at);
    if (found.value + rounding + ball.core().radius > 0) continue;  // the middle is outside
    const double way = 1e-4 * (solid.ball_radius() + ball.ball_radius());
    const SignedDistance deeper = depth_at(turn * at - way * found.normal);
    const double lean = (deeper.value - (found.value - way)) / way;  // 1 less a cosine
    const bool is_one = found.has_one_direction;
    (is_one ? one : several) += 1;
    if (is_one) {
      ASSERT_LT(lean, 1e-6) << k << " " << at.transpose();
    }
    // A step that leans so far shows a second direction.
    if (lean > 1e-3) {
      ASSERT_FALSE(is_one) << k << " " << at.transpose();
    }
  }
  EXPECT_GT(one, 5000);
  EXPECT_GT(several, 200);
}

}  // namespace
}  // namespace minkray
