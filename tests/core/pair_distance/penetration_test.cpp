// SPDX-License-Identifier: MIT
// Compares penetration depths with all candidates, in long double: the direction in which two
// polytopes are separated by the least translation is a face's normal of one of them, or at right
// angles to an edge of each.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::RandomShapes;
using Long = long double;
using Points = std::vector<Vec3<Long>>;

/// The gap between planes with normal n; not of unit length.
Long gap(const Points& a, const Points& b, const Vec3<Long>& n) {
  Long low = 1e30L, high = -1e30L;
  for (const Vec3<Long>& p : a) high = std::max(high, n.dot(p));
  for (const Vec3<Long>& p : b) low = std::min(low, n.dot(p));
  return (low - high) / n.norm();
}

/// Lines between any two points and planes through any three: edges and faces are among them, and
/// no other direction gives more than the largest gap.
Long largest_gap(const Points& a, const Points& b) {
  Long best = -1e30L;
  const auto try_normal = [&](const Vec3<Long>& n) {
    if (!(n.norm() > 1e-9L)) return;
    best = std::max({best, gap(a, b, n), gap(a, b, -n)});
  };
  for (const Points* points : {&a, &b})
    for (std::size_t i = 0; i < points->size(); ++i)
      for (std::size_t j = i + 1; j < points->size(); ++j)
        for (std::size_t k = j + 1; k < points->size(); ++k)
          try_normal(((*points)[j] - (*points)[i]).cross((*points)[k] - (*points)[i]));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = k + 1; l < b.size(); ++l) try_normal((a[j] - a[i]).cross(b[l] - b[k]));
  return best;
}

struct Polytope {
  Shape shape;
  std::vector<Vec3<double>> points;

  Points at(const Affine<double>& pose) const {
    Points placed;
    for (const Vec3<double>& p : points)
      placed.push_back(pose.linear.cast<Long>() * p.cast<Long>() + pose.translation.cast<Long>());
    return placed;
  }
};

Polytope random_polytope(int kind, RandomShapes& random) {
  Polytope made{Point(), {}};
  if (kind == 0) {
    const Vec3<double> half(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1));
    for (int i = 0; i < 8; ++i)
      made.points.emplace_back((i & 1) != 0 ? half.x() : -half.x(),
                               (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
    made.shape = Box{half};
    return made;
  }
  for (int i = 0; i < (kind == 1 ? 4 : 9); ++i) made.points.push_back(random.direction());
  made.shape = Hull{PointCloud(made.points)};
  return made;
}

void expect_exact(const Polytope& a, const Polytope& b, const Affine<double>& pose_a,
                  const Affine<double>& pose_b, const Vec3<double>& origin, int& overlapping) {
  Affine<double> far_a = pose_a, far_b = pose_b;
  far_a.translation += origin;
  far_b.translation += origin;
  const SignedDistance found =
      signed_distance(ContactShape(a.shape), far_a, ContactShape(b.shape), far_b);
  const Long truth = largest_gap(a.at(far_a), b.at(far_b));
  if (truth > 0) {
    ASSERT_GT(found.upper, 0);
    return;
  }
  ++overlapping;
  ASSERT_LE(found.lower, truth);
  ASSERT_GE(found.upper, truth);
  const double rounding = 1e-13 + 64 * tolerance::epsilon<double> * origin.norm();
  ASSERT_LE(found.upper - found.lower, rounding);
  // Moving B by the depth along the normal makes the two touch, at the points of contact.
  Affine<double> apart = far_b;
  apart.translation -= found.value * found.normal;
  ASSERT_NEAR(static_cast<double>(largest_gap(a.at(far_a), b.at(apart))), 0, rounding);
  ASSERT_LE((found.point_b - found.point_a - found.value * found.normal).norm(), 100 * rounding);
}

TEST(Penetration, of_random_polytopes_is_the_least_of_all_candidates) {
  RandomShapes random(77);
  int overlapping = 0;
  for (int k = 0; k < 240; ++k) {
    const Polytope a = random_polytope(k % 3, random), b = random_polytope(k / 3 % 3, random);
    const Vec3<double> origin = k % 4 == 3 ? 1e3 * random.direction() : Vec3<double>(0, 0, 0);
    expect_exact(a, b, {random.turn(), {0, 0, 0}},
                 {random.turn(), random.in(0, 0.9) * random.direction()}, origin, overlapping);
    if (HasFatalFailure()) FAIL() << k;
  }
  EXPECT_GT(overlapping, 120);
}

TEST(Penetration, of_boxes_that_stand_straight_is_that_of_their_faces) {
  RandomShapes random(78);
  int overlapping = 0;
  for (int k = 0; k < 200; ++k) {
    const Polytope a = random_polytope(0, random), b = random_polytope(0, random);
    // Turned by right angles, or nearly: edges are parallel, faces lie in one plane.
    const double almost = k % 2 == 0 ? 0 : std::pow(10, random.in(-14, -6));
    const Affine<double> turned{rotation_matrix(almost, 0.0, k % 3 == 0 ? 0.0 : 1.0, 1.0),
                                random.in(0, 0.8) * random.direction()};
    expect_exact(a, b, {}, turned, {0, 0, 0}, overlapping);
    if (HasFatalFailure()) FAIL() << k;
  }
  EXPECT_GT(overlapping, 80);
}

TEST(Penetration, one_body_in_the_middle_of_another_leaves_by_the_nearest_face) {
  const ContactShape cube(Shape(Box{{3, 2, 1}})), ball(Shape(Sphere{0.25})),
      rod(Shape(Cylinder{0.25, 0.5}));
  EXPECT_NEAR(signed_distance(cube, {}, cube, {}).value, -2, 1e-13);
  EXPECT_NEAR(signed_distance(cube, {}, ball, {}).value, -1.25, 1e-13);
  EXPECT_NEAR(signed_distance(cube, {}, rod, {}).value, -1.5, 1e-9);
  EXPECT_NEAR(signed_distance(rod, {}, ball, {}).value, -0.5, 1e-9);
  EXPECT_NEAR(signed_distance(rod, {}, rod, {}).value, -0.5, 1e-9);
}

/// A corner of the upper cube is over an edge of the lower one, or off it by `out`.
///       ______
///      |      |
///      |______|_____
/// |______| | first contact: the area that the two faces have in common
///             |_____|
TEST(Penetration, of_cubes_is_seen_at_points_of_both_where_a_corner_stands_out) {
  const ContactShape cube(Shape(Box{{1, 1, 1}}));
  const double size = 2 * cube.ball_radius();
  for (const double out : {1e-12, -1e-12, 1.5e-11, -1.5e-11}) {
    const Vec3<double> middle(out, 0, 1.875);
    const SignedDistance found = signed_distance(cube, {}, cube, shifted_by(middle));
    EXPECT_NEAR(found.value, -0.125, 1e-14);
    const double of_a = found.point_a.cwiseAbs().maxCoeff() - 1,
                 of_b = (found.point_b - middle).cwiseAbs().maxCoeff() - 1;
    EXPECT_LE(std::max(of_a, of_b), 1e-12 * size + 1e-15) << out;
    // An offset of no more than that is no reason to search.
    if (std::abs(out) < 1e-12 * size) {
      EXPECT_EQ(found.supports, 0) << out;
    }
  }
}

TEST(Penetration, of_curved_pairs_next_to_touching_seldom_takes_branch_and_bound) {
  // A third of the cones that overlap by less than a millionth took half a millisecond.
  using testing::Body;
  testing::RandomShapes random(53);
  constexpr int ellipsoid = 4, cylinder = 7, cone = 8, box = 5;
  constexpr int kinds[][2] = {
      {cone, cone}, {cylinder, cone}, {box, cylinder}, {ellipsoid, cone}, {ellipsoid, ellipsoid}};
  int slow = 0, all = 0;
  for (const auto& [i, j] : kinds)
    for (int k = 0; k < 400; ++k, ++all) {
      const Body a(testing::random_shape(i, 1, random), {random.turn(), Vec3<double>::Zero()});
      Body b(testing::random_shape(j, 1, random), {random.turn(), 3 * random.direction()});
      const double size = testing::size_of(a, b);
      testing::bring_near(a, b, -std::pow(10, random.in(-12, -6)), size);
      const SignedDistance found = signed_distance(a, b);
      ASSERT_EQ(testing::complaint(a, b, found, random), "") << i << ", " << j << ", " << k;
      slow += found.supports > 150;
    }
  EXPECT_LT(slow, all / 20);
}

}  // namespace
}  // namespace minkray
