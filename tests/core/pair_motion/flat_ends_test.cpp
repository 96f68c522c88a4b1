// SPDX-License-Identifier: MIT
// Bodies that arrive on a flat end of a cylinder, a cone or a disk: the time is the distance of a
// support plane over the speed, in long double. The support point of an end jumps, so searches by
// curvature need this case on its own.
#include <gtest/gtest.h>

#include "core/pair_motion/impact.h"
#include "tests/core/pair_distance/random_bodies.h"

namespace minkray {
namespace {

using testing::kinds_of_bodies;
using testing::random_shape;
using testing::RandomShapes;
using Long = long double;

/// A body of revolution with a flat upper end: its shape, the end's radius, and its height.
struct Ended {
  Shape shape;
  double rim, height;
};

Ended random_ended(int kind, RandomShapes& random) {
  const double radius = random.in(0.5, 1.5), half = random.in(0.2, 1);
  if (kind == 0) return {Cylinder{radius, half}, radius, half};
  if (kind == 1) return {Disk{radius}, radius, 0};
  if (kind == 2) return {Frustum{{random.in(0.1, 2), radius}, half}, radius, half};
  const double rounding = random.in(0.1, 0.5);
  return {Rounded{rounding, Nested(Shape(Cylinder{radius, half}))}, radius, half + rounding};
}

/// Moves `shape`, turned, so that its lowest point arrives on the end within the rim at the time
/// `t`, with a tilted velocity. Checks the first contact's time and point, with either body first.
void arrives(const Ended& ended, const Shape& shape, RandomShapes& random, bool is_second) {
  const Mat3<double> turn = random.turn();
  const Shape turned = Transform{shape, Affine<double>{turn, Vec3<double>::Zero()}};
  const Vec3<double> low = turned.support(Vec3<double>(0, 0, -1));
  const double angle = random.in(0, 6), out = random.in(0, 0.95) * ended.rim,
               t = random.in(0.3, 0.9);
  const Vec3<double> landing(out * std::cos(angle), out * std::sin(angle), ended.height);
  const Vec3<double> velocity(random.in(-3, 3), random.in(-3, 3), -random.in(1, 4));
  const Vec3<double> start = landing - low - t * velocity;
  const Long exact =
      (static_cast<Long>(start.z()) + low.z() - ended.height) / -static_cast<Long>(velocity.z());

  const Affine<double> frame{random.turn(), 2 * random.direction()};
  const ContactShape a(ended.shape), b(shape);
  RigidMotion of_a, of_b;
  of_a.pose = frame;
  of_b.pose = {frame.linear * turn, frame(start)};
  of_b.velocity = frame.linear * velocity;
  const Impact found =
      is_second ? first_impact(b, of_b, a, of_a, 1) : first_impact(a, of_a, b, of_b, 1);
  ASSERT_EQ(found.status, ImpactStatus::hit);
  constexpr Long rounding = 1e-13L;  // of the frames, which are not part of the bounds
  EXPECT_LE(found.t_lo, exact + rounding);
  EXPECT_GE(found.t_hi, exact - rounding);
  EXPECT_LE(found.t_hi - found.t_lo, 1e-9);
  const Vec3<double> at = is_second ? found.point_b : found.point_a;
  // A ball of radius 1 that is 1e-10 above a plane is within 1.4e-5 of its lowest point there.
  EXPECT_LE((at - frame(landing)).norm(), 3e-5);
}

TEST(FlatEnds, bodies_that_arrive_within_the_rim_touch_at_the_time_of_their_lowest_point) {
  RandomShapes random(71);
  for (int k = 0; k < 6000; ++k) {
    SCOPED_TRACE(k);
    const Ended ended = random_ended(k % 4, random);
    const Shape shape = random_shape(k / 4 % kinds_of_bodies, 0.6, random);
    arrives(ended, shape, random, k % 2 == 1);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace minkray
