// SPDX-License-Identifier: MIT
// Signed distances that are known otherwise: by closed forms, by Wolfe's method and by the facets
// of the shapes' difference.
#include <gtest/gtest.h>

#include "core/pair_motion/impact.h"
#include "tests/core/pair_distance/random_bodies.h"
#include "tests/oracle/wolfe.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using Long = long double;
using testing::Body;
using testing::random_shape;
using testing::RandomShapes;

/// The distance of two segments in long double.
double distance_of_segments(const std::array<Vec3<double>, 2>& a,
                            const std::array<Vec3<double>, 2>& b) {
  std::vector<oracle::Column<3>> differences;
  for (const Vec3<double>& p : a)
    for (const Vec3<double>& q : b) differences.push_back(q.cast<Long>() - p.cast<Long>());
  return static_cast<double>(oracle::nearest_to_origin<3>(differences).norm());
}

TEST(SignedDistance, spheres_capsules_and_boxes_have_closed_forms) {
  RandomShapes random(7);
  for (int k = 0; k < 20000; ++k) {
    const double size = std::pow(10, random.in(-3, 3));
    const Vec3<double> p = size * random.direction(), q = size * random.direction(),
                       r = size * random.direction() * random.in(0, 2),
                       s = size * random.direction();
    const double r1 = size * random.in(0.01, 1), r2 = size * random.in(0.01, 1);
    const auto round = [](double radius, const Shape& core) {
      return ContactShape(Rounded{radius, Nested(core)});
    };
    const SignedDistance capsules =
        signed_distance(round(r1, Segment{{p, q}}), round(r2, Segment{{r, s}}));
    const double exact = distance_of_segments({p, q}, {r, s}) - r1 - r2;
    ASSERT_NEAR(capsules.value, exact, 1e-14 * 4 * size) << k;
    ASSERT_LE(capsules.lower, exact);
    ASSERT_GE(capsules.upper, exact);

    const SignedDistance balls = signed_distance(
        ContactShape(Transform{Nested(Shape(Sphere{r1})), shifted_by(p)}), round(r2, Point{q}));
    ASSERT_NEAR(balls.value, double((q.cast<Long>() - p.cast<Long>()).norm() - Long(r1) - Long(r2)),
                1e-14 * 4 * size);

    const Vec3<double> h = size * Vec3<double>(random.in(0, 1), random.in(0, 1), random.in(0, 1));
    const Vec3<Long> beyond = r.cast<Long>().cwiseAbs() - h.cast<Long>();
    const Long deepest = std::min(beyond.maxCoeff(), Long(0));
    const Vec3<Long> aside = beyond.cwiseMax(Vec3<Long>::Zero());
    const SignedDistance box = signed_distance(ContactShape(Box{h}), round(r1, Point{r}));
    ASSERT_NEAR(box.value, double(aside.norm() + deepest - Long(r1)), 1e-14 * 4 * size) << k;
  }
}

TEST(SignedDistance, hulls_are_as_deep_in_each_other_as_the_nearest_facet_of_their_difference) {
  RandomShapes random(5);
  int overlapping = 0;
  for (int k = 0; k < 1000; ++k) {
    const bool are_boxes = k % 4 == 0;
    const Body a(are_boxes ? random_shape(5, 1, random) : random.hull(4 + k % 20, 1),
                 {random.turn(), Vec3<double>::Zero()});
    const Body b(are_boxes ? random_shape(5, 1, random) : random.hull(4 + k % 13, 1),
                 {random.turn(), random.in(0, 1) * random.direction()});
    const SignedDistance result = signed_distance(a, b);
    if (result.status != SignedStatus::overlapping) continue;
    ++overlapping;
    const auto corners = [](const Body& body) {
      std::vector<Vec3<double>> points;
      if (const auto* hull = std::get_if<Hull>(&body.shape.kind)) {
        for (const Vec3<double>& p : hull->points.points()) points.push_back(body.pose(p));
      } else {
        for (int i = 0; i < 8; ++i)
          points.push_back(body.pose(body.shape.support(
              Vec3<double>((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1))));
      }
      return points;
    };
    std::vector<Vec3<double>> differences;
    for (const Vec3<double>& p : corners(a))
      for (const Vec3<double>& q : corners(b)) differences.push_back(q - p);
    const PointCloud difference(differences);
    ASSERT_NE(difference.facets(), nullptr);
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < difference.facets()->size(); ++i) {
      const auto& facet = (*difference.facets())[i];
      if (facet.normal().isZero(0)) continue;
      depth = std::min(depth, facet.normal().dot(difference.support(facet.normal())));
    }
    ASSERT_NEAR(result.value, -depth, 1e-13) << k;
    ASSERT_LE(result.upper - result.lower, 1e-9 * (testing::size_of(a, b))) << k;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(SignedDistance, shapes_in_the_middle_of_each_other_are_as_deep_as_their_thinnest_sum) {
  // Every direction is as good as any other here, or a circle of them is.
  const ContactShape ball(Sphere{2}), inner(Sphere{1});
  EXPECT_NEAR(signed_distance(ball, inner).value, -3, 1e-14);
  const ContactShape rod(Cylinder{1, 5}), thin(Cylinder{0.25, 5});
  SignedDistanceOptions coarse;
  coarse.tolerance = 1e-5;
  const SignedDistance coaxial = signed_distance(rod, {}, thin, {}, coarse);
  EXPECT_NEAR(coaxial.value, -1.25, 1e-4);
  EXPECT_LE(coaxial.lower, -1.25);
  EXPECT_GE(coaxial.upper, -1.25);
  const ContactShape cube(Box{{1, 1, 1}});
  EXPECT_NEAR(signed_distance(cube, cube).value, -2, 1e-14);
}

TEST(SignedDistance, of_what_has_a_part_without_length_is_known) {
  // A capsule that is a ball, or whose length has no square, in one that lies along x as it does.
  const Mat3<double> along_x =
      Eigen::AngleAxis<double>(std::acos(-1.0) / 2, Vec3<double>::UnitY()).toRotationMatrix();
  const ContactShape rod(Capsule{0.5, 2});
  for (const double half_height : {0.0, 1e-200})
    for (const double x : {0.0, 0.75}) {
      const ContactShape ball(Capsule{0.25, half_height});
      const SignedDistance inside =
          signed_distance(rod, {along_x, {0, 0, 0}}, ball, {along_x, {x, 0, 0}});
      EXPECT_NEAR(inside.lower, -0.75, 1e-13) << half_height << ", " << x;
      EXPECT_NEAR(inside.upper, -0.75, 1e-13) << half_height << ", " << x;
    }
  // If two disks have no height only the larger one counts, from above and from below.
  for (const std::array<double, 2>& radii : {std::array{0.5, 1.0}, std::array{1.0, 0.5}})
    for (const double rho : {0.25, 0.75, 1.5})
      for (const double z : {-1.0, 1.0}) {
        const SignedDistance aside =
            signed_distance(ContactShape(Frustum{radii, 0}), ContactShape(Point{{rho, 0, z}}));
        EXPECT_NEAR(aside.value, std::hypot(std::max(rho - 1, 0.0), 1), 1e-14) << rho << ", " << z;
        EXPECT_LE(aside.upper - aside.lower, 1e-13);
      }
}

/// Products of lengths that are all 0 are numbers, too: a box that is a point was undecided in its
/// own place.
TEST(SignedDistance, of_bodies_that_are_points_is_that_of_points) {
  const std::vector<Shape> points{Point{{0, 0, 0}}, Sphere{0},           Box{{0, 0, 0}},
                                  Cylinder{0, 0},   Capsule{0, 0},       Cone{0, 0},
                                  Disk{0},          Ellipsoid{{0, 0, 0}}};
  for (const Shape& a : points)
    for (const Shape& b : points)
      for (const double away : {0.0, 0x1p-159, 1.0}) {
        const SignedDistance found =
            signed_distance(ContactShape(a), {}, ContactShape(b), shifted_by(0, away, 0));
        ASSERT_EQ(found.status, away > 0 ? SignedStatus::separated : SignedStatus::touching)
            << &a - points.data() << ", " << &b - points.data() << ", " << away;
        EXPECT_LE(found.lower, away);
        EXPECT_GE(found.upper, away);
        EXPECT_LE(found.upper - found.lower, 1e-13 * away);
        EXPECT_NEAR(found.normal.norm(), 1, 1e-15);
      }
}

/// Searches go by products of six lengths: up to 2^160 they are numbers, beyond nothing is
/// searched.
TEST(SignedDistance, is_known_up_to_the_largest_length_and_undecided_beyond) {
  const auto of_size = [](double unit) {
    const double half = 0.25 * unit;
    return std::vector<Shape>{Box{{half, half, half}}, Capsule{half, half}, Cylinder{half, half},
                              Ellipsoid{{half, half / 2, half}}};
  };
  // Sizes, of both together, are 0.87 to 1 of the unit; distances have a tolerance of 1e-10 of
  // them.
  constexpr double largest = 0x1p160;
  for (std::size_t i = 0; i < of_size(1).size(); ++i)
    for (const double unit : {largest * 0.9, largest * 0x1p-3, largest * 0x1p2}) {
      const ContactShape a(of_size(unit)[i]), b(of_size(unit)[i]);
      const SignedDistance found = signed_distance(a, {}, b, shifted_by(unit, 0, 0));
      if (unit > largest) {
        EXPECT_EQ(found.status, SignedStatus::undecided) << i;
        EXPECT_EQ(found.supports, 0) << i;
        continue;
      }
      EXPECT_EQ(found.status, SignedStatus::separated) << i << ", " << unit;
      EXPECT_NEAR(found.value / unit, 0.5, 1e-9) << i << ", " << unit;
    }
}

/// The radius counts as well, where the core itself is small.
TEST(SignedDistance, of_a_short_capsule_of_more_than_the_largest_length_is_undecided) {
  const ContactShape capsule(Capsule{0x1p161, 1}), ball(Sphere{0x1p161});
  const Affine<double> beside{shifted_by(0x1p163, 0, 0)};
  EXPECT_EQ(signed_distance(capsule, {}, capsule, beside).status, SignedStatus::undecided);
  EXPECT_EQ(signed_distance(ball, {}, ball, beside).status, SignedStatus::separated);
  const RigidMotion rests, comes{beside, {-0x1p161, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(first_impact(capsule, rests, capsule, comes, 10).status, ImpactStatus::undecided);
  EXPECT_EQ(first_impact(ball, rests, ball, comes, 10).status, ImpactStatus::hit);
}

}  // namespace
}  // namespace minkray
