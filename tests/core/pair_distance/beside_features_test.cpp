// SPDX-License-Identifier: MIT
// Bodies next to a corner, an edge or a rim of another, in a direction in which the nearest
// feature changes, from touching to far away. Rounding decides which feature it is there, and
// turns the direction by the more, the nearer the two are: of segments next to segments one in
// thirteen had a lower bound beyond its plane.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::Body;
using testing::kinds_of_bodies;
using testing::RandomShapes;
using P = Vec3<double>;

/// A shape, a point of its surface and a direction in which the point is the furthest.
struct Feature {
  Shape shape;
  P point, outwards;
};

P somewhere_between(const P& a, const P& b, RandomShapes& random) {
  return (random.in(0, 1) * a + random.in(0, 1) * b).normalized();
}

/// A direction of either neighbouring side, or one in between.
Feature feature(int kind, RandomShapes& random) {
  const double r = random.in(0.1, 1), h = random.in(0.1, 1), angle = random.in(0, 7);
  const P around(std::cos(angle), std::sin(angle), 0), up = P::UnitZ();
  const auto one_of = [&](const P& a, const P& b) {
    const double choice = random.in(0, 3);
    return choice < 1 ? a : choice < 2 ? b : somewhere_between(a, b, random);
  };
  const P beside_box = one_of(P::UnitX(), random.in(0, 1) < 0.5 ? P::UnitY() : up);
  switch (kind) {
    case 0:
      return {Box{{r, h, 0.5}}, {r, h, 0.5}, beside_box};
    case 1:
      return {Cylinder{r, h}, r * around + h * up, one_of(around, up)};
    case 2: {
      const P side = (2 * h * around + r * up).normalized();
      return {Cone{r, h}, r * around - h * up, one_of(side, -up)};
    }
    case 3: {
      const P side = (2 * h * around + r * up).normalized();
      return {Cone{r, h}, h * up, one_of(side, up)};
    }
    case 4:
      return {Capsule{r, h}, h * up + r * around, around};
    case 5:
      return {Triangle{{P(0, 0, 0), P(r, 0, 0), P(0.3 * r, h, 0)}},
              random.in(0, 1) < 0.5 ? P(0, 0, 0) : P(random.in(0, 1) * r, 0, 0),
              one_of(up, -P::UnitY())};
    case 6:
      return {Disk{r}, r * around, one_of(around, up)};
    case 7:
      return {Rounded{0.1, Nested(Shape(Box{{r, h, 0.5}}))}, P(r, h, 0.5) + 0.1 * beside_box,
              beside_box};
    default:
      return {Segment{{P(0, 0, 0), h * up}}, random.in(0, 2) < 1 ? P(h * up) : P(0, 0, 0), around};
  }
}
constexpr int kinds_of_features = 9;

/// A turn that leads z to `up`.
Mat3<double> upright(const P& up) {
  Mat3<double> turn;
  turn.col(0) = up.unitOrthogonal();
  turn.col(1) = up.cross(turn.col(0));
  turn.col(2) = up;
  return turn;
}

/// A body that touches the plane through `at` with this normal from above, there with a point, an
/// end or an edge.
Body beside(int kind, const P& at, const P& normal, double away, const Mat3<double>& turn,
            RandomShapes& random) {
  const Mat3<double> up = upright(normal);
  const double side = random.in(0, 1) < 0.5 ? 1 : -1, r = random.in(0.1, 1);
  switch (kind) {
    case 0:
      return {Shape(Point{P::Zero()}), shifted_by(at)};
    case 1:
      return {Shape(Sphere{0.25 * away}), shifted_by(at)};
    case 2: {
      const double angle = random.in(0, 7);
      const P across =
          random.in(0, 1) < 0.2 ? P(turn.col(2)) : P(up * P(std::cos(angle), std::sin(angle), 0));
      return {Shape(Segment{{P::Zero(), random.in(0.1, 1) * across}}), shifted_by(at)};
    }
    case 3:
      return {Shape(Box{{r, 0.3, 0.2}}), {up, at + up * P(side * r, 0.3, 0.2)}};
    default:
      return {Shape(Cylinder{r, 0.2}), {up, at + up * P(side * r, 0, 0.2)}};
  }
}
constexpr int kinds_beside = 5;

TEST(BesideFeatures, planes_points_and_bounds_hold) {
  RandomShapes random(15), judge(16);
  for (int k = 0; k < 200 * kinds_of_features * kinds_beside; ++k) {
    const Feature of = feature(k % kinds_of_features, random);
    const Mat3<double> turn = random.turn();
    const double away = std::pow(10, random.in(-9, 0));
    const P normal = turn * of.outwards;
    const Body a(of.shape, {turn, P::Zero()});
    const Body b = beside(k / kinds_of_features % kinds_beside, turn * of.point + away * normal,
                          normal, away, turn, random);
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
    const SignedDistance reversed = signed_distance(b, a);
    ASSERT_EQ(testing::complaint(b, a, reversed, judge), "") << k;
  }
}

// Sides that are parallel, faces on faces, rims on sides: bodies of all kinds that turn their axes,
// sides and corners to each other. The points of rounded ones were as far aside of the normal as
// those of their cores, up to 1.4e-5 of the size where 3e-6 is promised.
TEST(BesideFeatures, bodies_that_turn_their_axes_to_each_other_have_points_that_hold) {
  RandomShapes random(15), judge(16);
  const P directions[] = {P::UnitX(),
                          P::UnitY(),
                          P::UnitZ(),
                          -P::UnitX(),
                          -P::UnitZ(),
                          P(1, 1, 0).normalized(),
                          P(1, 0, 1).normalized()};
  const auto one_direction = [&] { return directions[static_cast<int>(random.in(0, 7))]; };
  for (int k = 0; k < 20 * kinds_of_bodies * kinds_of_bodies; ++k) {
    const Shape of_a = testing::random_shape(k % kinds_of_bodies, 1, random),
                of_b = testing::random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random);
    const P to_b = one_direction(), to_a = one_direction();
    const Mat3<double> turn = random.turn();
    const P normal = turn * to_b;
    const double quarters[] = {0, std::numbers::pi / 2, random.in(0, 7)};
    const Mat3<double> spin =
        Eigen::AngleAxis<double>(quarters[k % 3], P::UnitZ()).toRotationMatrix();
    const Mat3<double> turn_b = upright(-normal) * spin * upright(to_a).transpose();
    const double away = std::pow(10, random.in(-9, 0));
    const Body a(of_a, {turn, P::Zero()});
    const P touched = turn * of_a.support(to_b) - turn_b * of_b.support(to_a);
    const Body b(of_b, {turn_b, touched + away * normal});
    const SignedDistance found = signed_distance(a, b);
    ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
  }
}

}  // namespace
}  // namespace minkray
