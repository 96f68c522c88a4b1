// SPDX-License-Identifier: MIT
// Points and balls that are added to a shape, or that a shape is taken from, move it and make it
// rounder: what is left is as well known as before, and as fast.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/pair_judge.h"

namespace minkray {
namespace {

using testing::Body;
using testing::RandomShapes;

Shape sum_of(std::initializer_list<Shape> operands) {
  ShapeList shapes;
  for (const Shape& operand : operands) shapes.push_back(operand);
  return MinkowskiSum{shapes};
}

/// A shape with balls and points about it, one way or another.
Shape with_balls(int way, const Shape& shape, RandomShapes& random) {
  const Shape ball = Sphere{random.in(0.1, 0.5)}, point = Point{random.direction()};
  switch (way) {
    case 0:
      return sum_of({ball, shape, point});
    case 1:
      return MinkowskiDifference{shape, sum_of({ball, point})};
    case 2:
      return MinkowskiDifference{point, shape};
    default:
      return sum_of({sum_of({shape, point}), Rounded{0.25, Nested(point)}});
  }
}

TEST(SumsWithBalls, are_as_well_known_as_what_they_are_added_to) {
  RandomShapes random(83);
  for (int k = 0; k < 1500; ++k) {
    const Shape inner = testing::random_shape(k % 15, 1, random);
    const Shape sum = with_balls(k % 4, inner, random);
    const ContactShape of_inner(inner), of_sum(sum);
    ASSERT_EQ(of_sum.core().kind, of_inner.core().kind) << k;
    // Under a map that keeps angles, and under one that does not.
    Mat3<double> map = random.turn() * random.in(0.5, 2);
    if (k % 5 == 0) map = map * Vec3<double>(1, 2, 0.5).asDiagonal();
    const Transform moved{Nested(sum), Affine<double>{map, random.direction()}};
    const Body a(moved, {random.turn(), Vec3<double>::Zero()}),
        b(testing::random_shape(k / 15 % testing::kinds_of_bodies, 1, random),
          {random.turn(), random.in(0, 5) * random.direction()});
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, random), "") << k;
  }
}

}  // namespace
}  // namespace minkray
