// SPDX-License-Identifier: MIT
// Bodies that go and turn while time goes from 0 to 1.
#include "core/world/movement.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace minkray {
namespace {

struct Draw {
  std::mt19937_64 random{5};
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec3<double> point(double reach) {
    return {within(-reach, reach), within(-reach, reach), within(-reach, reach)};
  }
  Movement<double> movement(double most_angle) {
    return {point(2), within(0, most_angle), unit<double>(point(1)), point(3)};
  }
};

TEST(Movement, the_way_back_is_the_way_there) {
  Draw draw;
  for (int i = 0; i < 1000; ++i) {
    const Movement<double> movement = draw.movement(7);
    const Vec3<double> point = draw.point(5);
    const double time = draw.within(0, 1);
    constexpr double rounding = 2e-14;  // of numbers up to 10, ten roundings each
    EXPECT_LT((movement.unmoved(movement.moved(point, time), time) - point).norm(), rounding);
    const Ray<double> seen =
        movement.unmoved(Ray<double>{movement.moved(point, time), point}, time);
    EXPECT_LT((movement.turned(seen.direction, time) - point).norm(), rounding);
  }
}

TEST(Movement, a_quarter_turn_about_a_pivot_that_goes) {
  const Movement<double> movement{{0, 0, 2}, std::numbers::pi / 2, {0, 0, 1}, {1, 0, 0}};
  EXPECT_LT((movement.moved(Vec3<double>(2, 0, 0), 1) - Vec3<double>(1, 1, 2)).norm(), 1e-15);
  const Vec3<double> half(1 + std::sqrt(0.5), std::sqrt(0.5), 1);
  EXPECT_LT((movement.moved(Vec3<double>(2, 0, 0), 0.5) - half).norm(), 1e-15);
  const Affine<double> pose{Vec3<double>(1, 2, 3).asDiagonal(), {2, 0, 0}};
  const Vec3<double> corner = movement.moved(pose, 1)(Vec3<double>(1, 1, 1));
  EXPECT_LT((corner - movement.moved(pose(Vec3<double>(1, 1, 1)), 1)).norm(), 1e-15);
}

/// The box of a box's corners after a while.
Bounds<double> box_at(const Movement<double>& movement, const Bounds<double>& box, double time) {
  Bounds<double> now;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3<double> point;
    for (int i = 0; i < 3; ++i) point[i] = corner >> i & 1 ? box.upper[i] : box.lower[i];
    now.extend(movement.moved(point, time));
  }
  return now;
}

TEST(Movement, swept_boxes_hold_every_moment_and_are_no_larger_than_need_be) {
  Draw draw;
  double loosest = 0;
  for (int i = 0; i < 2000; ++i) {
    const Movement<double> movement = draw.movement(i % 2 == 0 ? 0.5 : 12);
    const Vec3<double> middle = draw.point(3);
    const Vec3<double> half = draw.point(1).cwiseAbs();
    const Bounds<double> box{middle - half, middle + half};
    const Bounds<double> swept = movement.swept(box, box_at(movement, box, 1));
    Bounds<double> seen;
    for (int k = 0; k <= 200; ++k) seen.extend(box_at(movement, box, k / 200.0));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(swept.lower[axis], seen.lower[axis] + 1e-12);
      EXPECT_GE(swept.upper[axis], seen.upper[axis] - 1e-12);
    }
    if (movement.angle < 0.5)
      loosest = std::max(loosest, (swept.half_extents() - seen.half_extents()).maxCoeff());
  }
  // rho angle^2 / 8, where rho is at most the diagonal of what pivot, middle and half reach to.
  EXPECT_LT(loosest, (3 + 3 + 1) * std::sqrt(3.0) * 0.25 / 8);
  EXPECT_GT(loosest, 0);
}

}  // namespace
}  // namespace minkray
