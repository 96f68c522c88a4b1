// SPDX-License-Identifier: MIT
// Points of contact: how many there are of what rests on what, and that they are of the shapes.
#include "core/pair_distance/manifold.h"

#include <gtest/gtest.h>

#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

const Shape plate(Box{{5, 5, 0.5}});

ContactManifold manifold_of(const Body& a, const Body& b) {
  return contact_manifold(a.ready, a.pose, b.ready, b.pose, signed_distance(a, b));
}

Affine<double> at(double x, double y, double z) {
  return shifted_by(x, y, z);
}

Affine<double> turned(const Vec3<double>& axis, double angle, const Vec3<double>& to) {
  return {Eigen::AngleAxis<double>(angle, axis.normalized()).toRotationMatrix(), to};
}

/// Each point is of both shapes, to rounding, and the gap is the reported one.
void expect_of_shapes(const Body& a, const Body& b, const ContactManifold& found,
                      RandomShapes& random) {
  const double size = size_of(a, b) + 1e-6;
  for (int i = 0; i < found.count; ++i) {
    const ContactPoint& point = found.points[static_cast<std::size_t>(i)];
    EXPECT_LE((point.point_b - point.point_a - point.distance * found.normal).norm(), 1e-6 * size);
    EXPECT_LE(outside(a, point.point_a, found.normal, random), 2e-6 * size);
    EXPECT_LE(outside(b, point.point_b, -found.normal, random), 2e-6 * size);
  }
}

TEST(ContactManifold, of_a_box_that_rests_on_a_plate_are_its_corners) {
  RandomShapes random(1);
  for (const double deep : {-1e-3, 0.0, 1e-3}) {
    const Body a(plate, at(0, 0, 0)),
        b(Shape(Box{{1, 0.5, 0.25}}), turned({0, 0, 1}, 0.3, {0.2, 0.1, 0.75 - deep}));
    const ContactManifold found = manifold_of(a, b);
    ASSERT_EQ(found.count, 4) << deep;
    expect_of_shapes(a, b, found, random);
    for (const ContactPoint& point : found.points) EXPECT_NEAR(point.distance, -deep, 1e-9);
    // The points are around the box' middle.
    double area = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) {
          const auto p = [&](int n) { return found.points[static_cast<std::size_t>(n)].point_a; };
          area = std::max(area, 0.5 * (p(j) - p(i)).cross(p(k) - p(i)).z());
        }
    EXPECT_GT(area, 0.9);
  }
}

TEST(ContactManifold, of_other_things_has_as_many_points_as_touch) {
  const auto count = [](const Shape& b, const Affine<double>& pose) {
    return manifold_of(Body(plate, at(0, 0, 0)), Body(b, pose)).count;
  };
  const Shape cylinder(Cylinder{0.5, 1}), ball(Sphere{1}), capsule(Capsule{0.25, 1}),
      box(Box{{1, 0.5, 0.25}});
  const Vec3<double> x = Vec3<double>::UnitX();
  EXPECT_EQ(count(cylinder, at(0, 0, 1.5)), 4);
  EXPECT_EQ(count(cylinder, turned(x, 1.5707963267948966, {0, 0, 1})), 2);
  EXPECT_EQ(count(capsule, turned(x, 1.5707963267948966, {0, 0, 0.75})), 2);
  EXPECT_EQ(count(ball, at(0, 0, 1.5)), 1);
  // On a corner, on an edge.
  EXPECT_EQ(count(box, turned({1, 1, 0}, 0.6, {0, 0, 2})), 1);
  EXPECT_EQ(count(box, turned(x, 0.5, {0, 0, 2})), 2);
}

TEST(ContactManifold, of_a_box_that_leans_over_an_edge_is_of_its_face_there_too) {
  const Body below(plate, at(0, 0, 0)),
      box(Shape(Box{{1, 0.5, 0.25}}), turned({0, 1, 0}, -0.01, {5, 0, 0.76}));
  for (const bool is_box_first : {false, true}) {
    const ContactManifold found = is_box_first ? manifold_of(box, below) : manifold_of(below, box);
    ASSERT_EQ(found.count, 4);
    int at_edge = 0;
    for (const ContactPoint& point : found.points) {
      const Vec3<double>&on_box = is_box_first ? point.point_a : point.point_b,
            &on_plate = is_box_first ? point.point_b : point.point_a;
      const Vec3<double> in_box = box.pose.linear.transpose() * (on_box - box.pose.translation);
      EXPECT_NEAR(in_box.z(), -0.25, 1e-9);
      EXPECT_NEAR(on_plate.z(), 0.5, 1e-9);
      at_edge += std::abs(on_plate.x() - 5) < 1e-9 ? 1 : 0;
    }
    EXPECT_EQ(at_edge, 2);
  }
}

TEST(ContactManifold, of_any_two_shapes_is_of_both) {
  RandomShapes random(7);
  int many = 0;
  for (int k = 0; k < 10 * kinds_of_bodies * kinds_of_bodies; ++k) {
    RandomPair pair =
        random_pair(k % kinds_of_bodies, k / kinds_of_bodies % kinds_of_bodies, 0, random);
    if (k % 2 == 0) pair.b.pose.linear = pair.a.pose.linear;
    bring_near(pair.a, pair.b, 1e-6, size_of(pair.a, pair.b));
    const ContactManifold found = manifold_of(pair.a, pair.b);
    ASSERT_GE(found.count, 1);
    many += found.count > 1;
    expect_of_shapes(pair.a, pair.b, found, random);
    if (HasFailure()) FAIL() << k;
  }
  EXPECT_GT(many, 100);
}

TEST(ContactManifold, of_an_unknown_distance_has_no_points) {
  const Shape ball = Sphere{1};
  EXPECT_EQ(manifold_of(Body(ball, at(0, 0, 0)), Body(ball, at(1e200, 0, 0))).count, 0);
}

}  // namespace
}  // namespace minkray::testing
