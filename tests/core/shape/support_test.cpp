// SPDX-License-Identifier: MIT
// Properties of every shape's support mapping, checked on every kind and on random nestings.
#include <gtest/gtest.h>

#include "core/derived/shape_bounds.h"
#include "tests/support/random.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

std::vector<SampleShape> shapes() {
  return sample_shapes_and_nestings(0, 100);
}

/// Random ones, the axes, and directions that are nearly along an axis or a coordinate plane.
std::vector<Vec3<double>> directions(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Vec3<double>> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) all.push_back(sign * Vec3<double>::Unit(axis));
  for (int i = 0; i < count; ++i) {
    Vec3<double> n = random.direction();
    if (i % 4 == 1) n[i / 4 % 3] = 0;
    if (i % 4 == 2) n = Vec3<double>::Unit(i / 4 % 3) + 1e-9 * n;
    all.push_back(n);
  }
  return all;
}

/// A length that all rounding of supports is relative to: the largest coordinate that occurs.
double size_of(const Shape& shape) {
  const Bounds<double> bounds = bounds_of(shape);
  return static_cast<double>(
      std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff()));
}

/// Supports are a few operations, each rounded to epsilon / 2 of the largest intermediate result,
/// for each of up to four levels of nesting, whose operands may be larger than the whole.
constexpr double rounding_in_epsilons = 64;

TEST(Supports, maximise_over_the_support_points_of_other_directions) {
  const auto all = directions(1, 150);
  for (const SampleShape& sample : shapes()) {
    const Shape shape = sample.shape;
    const double rounding =
        rounding_in_epsilons * std::numeric_limits<double>::epsilon() * size_of(shape);
    std::vector<Vec3<double>> n, s;
    for (const auto& direction : all) {
      n.push_back(direction);
      s.push_back(shape.support(direction));
    }
    for (std::size_t i = 0; i < n.size(); ++i)
      for (std::size_t j = 0; j < n.size(); ++j)
        ASSERT_LE(n[i].dot(s[j] - s[i]), rounding * n[i].norm())
            << sample.name << ", n " << n[i].transpose() << ", beaten by that of "
            << n[j].transpose();
  }
}

TEST(Supports, do_not_depend_on_the_length_of_the_direction) {
  const auto all = directions(2, 60);
  for (const SampleShape& sample : shapes()) {
    const Shape shape = sample.shape;
    const double rounding =
        rounding_in_epsilons * std::numeric_limits<double>::epsilon() * size_of(shape);
    for (const auto& direction : all)
      for (const double length : {0x1p-40, 0x1p40}) {
        const Vec3<double> longer = direction * double(length);
        const double here = double(direction.dot(shape.support(direction))),
                     there = double(direction.dot(shape.support(longer)));
        ASSERT_NEAR(here, there, rounding)
            << sample.name << ", direction " << direction.transpose();
      }
  }
}

TEST(Supports, of_a_zero_direction_are_points_of_the_shape) {
  for (const SampleShape& sample : shapes()) {
    const Shape shape = sample.shape;
    const double rounding =
        rounding_in_epsilons * std::numeric_limits<double>::epsilon() * size_of(shape);
    const Vec3<double> some = shape.support(Vec3<double>(Vec3<double>::Zero()));
    for (const auto& direction : directions(4, 100)) {
      ASSERT_LE(direction.dot(some), direction.dot(shape.support(direction)) + rounding)
          << sample.name;
    }
  }
}

TEST(Supports, bounds_contain_and_touch) {
  for (const SampleShape& sample : shapes()) {
    const Shape shape = sample.shape;
    const Bounds<double> bounds = bounds_of(shape);
    const Ball<double> ball = ball_around(bounds);
    const double rounding = double(rounding_in_epsilons) * std::numeric_limits<double>::epsilon() *
                            double(size_of(shape));
    Bounds<double> reached;
    for (const auto& direction : directions(5, 500)) {
      const Vec3<double> s = shape.support(Vec3<double>(direction));
      reached.extend(s);
      ASSERT_LE((s - ball.centre).norm(), ball.radius + rounding) << sample.name;
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(reached.lower[axis], bounds.lower[axis] - rounding) << sample.name;
      ASSERT_LE(reached.upper[axis], bounds.upper[axis] + rounding) << sample.name;
      ASSERT_LE(reached.lower[axis], bounds.lower[axis] + rounding) << sample.name;
      ASSERT_GE(reached.upper[axis], bounds.upper[axis] - rounding) << sample.name;
    }
  }
}

// Two descriptions of the same shape.

Shape shape_at(Shape shape, const Mat3<double>& linear, const Vec3<double>& by) {
  return Transform{std::move(shape), AffineMap(Affine<double>{linear, by})};
}

struct Pair {
  const char* name;
  Shape a, b;
};

std::vector<Pair> pairs() {
  using S = Shape;
  using P = Vec3<double>;
  const Mat3<double> identity = Mat3<double>::Identity(), turn = Random(3).rotation();
  const S box = Box{{1, 0.5, 0.25}}, ball = Sphere{0.3};
  const S axis = Segment{{P(0, 0, -1), P(0, 0, 1)}};
  const S cone = Cone{1, 0.7};
  std::vector<P> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 0.5 : -0.5, i & 4 ? 0.25 : -0.25);
  const S egg = Ellipsoid{{1, 2, 3}};
  const auto leaning = [&](double along_x, double along_y) {
    Mat3<double> linear = identity;
    linear(2, 0) = along_x;
    linear(2, 1) = along_y;
    return linear;
  };
  return {
      {"a rounded shape is a sum with a ball", Rounded{0.3, box}, MinkowskiSum{{box, ball}}},
      {"rounding adds up", Rounded{0.1, S(Rounded{0.2, cone})}, Rounded{0.1 + 0.2, cone}},
      {"a sphere is a rounded point", Sphere{2}, Rounded{2, S(Point{})}},
      {"a segment is the hull of its ends", Segment{{P(1, 2, 3), P(-1, 0, 5)}},
       HullOf{{S(Point{{1, 2, 3}}), S(Point{{-1, 0, 5}})}}},
      {"a capsule is a rounded segment", Capsule{0.4, 1}, Rounded{0.4, axis}},
      {"a tapered capsule is the hull of its balls", TaperedCapsule{{0.8, 0.3}, 1},
       HullOf{{shape_at(Sphere{0.8}, identity, P(0, 0, -1)),
               shape_at(Sphere{0.3}, identity, P(0, 0, 1))}}},
      {"a cylinder is the sum of disk and segment", Cylinder{0.6, 1},
       MinkowskiSum{{S(Disk{0.6}), axis}}},
      {"a cut cylinder is the hull of two ellipses",
       CutCylinder{0.8, {-0.5, 1}, {0.2, -0.3}, {0.5, 0.4}},
       HullOf{{shape_at(Disk{0.8}, leaning(0.2, -0.3), P(0, 0, -0.5)),
               shape_at(Disk{0.8}, leaning(0.5, 0.4), P(0, 0, 1))}}},
      {"a cylinder that is cut straight is a cylinder", CutCylinder{0.6, {-1, 1}},
       Cylinder{0.6, 1}},
      {"a cone is a frustum without top", cone, Frustum{{1, 0}, 0.7}},
      {"a frustum of equal radii is a cylinder", Frustum{{0.6, 0.6}, 1}, Cylinder{0.6, 1}},
      {"a frustum is the hull of its disks", Frustum{{1, 0.4}, 0.5},
       HullOf{{shape_at(Disk{1}, identity, P(0, 0, -0.5)),
               shape_at(Disk{0.4}, identity, P(0, 0, 0.5))}}},
      {"an ellipsoid is a stretched ball", egg,
       shape_at(Sphere{1}, P(1, 2, 3).asDiagonal(), P(0, 0, 0))},
      {"a superellipsoid of exponent 2 is an ellipsoid", Superellipsoid{{1, 2, 3}, 2}, egg},
      {"a superellipsoid of exponent 1 is an octahedron", Superellipsoid{{1, 2, 3}, 1},
       Hull{PointCloud(
           {P(1, 0, 0), P(-1, 0, 0), P(0, 2, 0), P(0, -2, 0), P(0, 0, 3), P(0, 0, -3)})}},
      {"a box is the hull of its corners", box, Hull{PointCloud(corners)}},
      {"a box is a sum of three segments", box,
       MinkowskiSum{{S(Segment{{P(-1, 0, 0), P(1, 0, 0)}}),
                     S(Segment{{P(0, -0.5, 0), P(0, 0.5, 0)}}),
                     S(Segment{{P(0, 0, -0.25), P(0, 0, 0.25)}})}}},
      {"a difference is a sum with the mirror image", MinkowskiDifference{box, cone},
       MinkowskiSum{{box, shape_at(cone, -identity, P(0, 0, 0))}}},
      {"a triangle is the hull of its corners", Triangle{{P(0, 0, 0), P(1, 0, 0), P(0, 1, 2)}},
       Hull{PointCloud({P(0, 0, 0), P(1, 0, 0), P(0, 1, 2)})}},
      {"maps of a sum are sums of maps", shape_at(MinkowskiSum{{box, cone}}, 2 * turn, P(1, 2, 3)),
       MinkowskiSum{{shape_at(box, 2 * turn, P(1, 2, 3)), shape_at(cone, 2 * turn, P(0, 0, 0))}}},
      {"maps of a hull are hulls of maps", shape_at(HullOf{{box, cone}}, turn, P(1, 2, 3)),
       HullOf{{shape_at(box, turn, P(1, 2, 3)), shape_at(cone, turn, P(1, 2, 3))}}},
      {"maps join", shape_at(shape_at(egg, turn, P(1, 0, 0)), 3 * turn, P(0, 1, 0)),
       shape_at(egg, 3 * turn * turn, 3 * turn * P(1, 0, 0) + P(0, 1, 0))},
  };
}

TEST(Supports, two_ways_to_say_a_shape_have_one_support_function) {
  for (const Pair& pair : pairs()) {
    const Shape a = pair.a, b = pair.b;
    const double rounding = rounding_in_epsilons * std::numeric_limits<double>::epsilon() *
                            std::max(size_of(a), size_of(b));
    for (const auto& direction : directions(6, 400)) {
      ASSERT_NEAR(double(direction.dot(a.support(direction))),
                  double(direction.dot(b.support(direction))), rounding)
          << pair.name << ", direction " << direction.transpose();
    }
  }
}

}  // namespace
}  // namespace minkray::testing
