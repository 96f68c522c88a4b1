// SPDX-License-Identifier: MIT
#include "core/geometry/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "core/geometry/point_cloud.h"
#include "tests/fuzz/hull_rounding.h"

namespace minkray {
namespace {

using Points = std::vector<Vec3<double>>;

Points on_ellipsoid(int count, const Vec3<double>& radii, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(Vec3<double>(normal(random), normal(random), normal(random))
                         .normalized()
                         .cwiseProduct(radii));
  return points;
}

Points corners_of_a_box() {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? 1.0 : -1.0, i & 2 ? 2.0 : -2.0, i & 4 ? 3.0 : -3.0);
  return points;
}

/// Distance of the given points outside of the hull's facets, relative to their size. The facets'
/// planes come from three corners each, so slivers are measured in the round frame.
double furthest_outside(const ConvexHull& hull, const Points& points) {
  double worst = 0;
  const double sense = hull.frame.axes.determinant() > 0 ? 1 : -1;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    const auto q = [&](std::size_t i) {
      return hull.frame.to_frame(points[hull.vertices[corners[i]]]);
    };
    Vec3<double> normal = Vec3<double>::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      normal += (q(i) - q(0)).cross(q(i + 1) - q(0));
    // Area instead of length: the heights of slivers count for as little as they are wide.
    for (const auto& p : points)
      worst = std::max(worst, sense * normal.dot(hull.frame.to_frame(p) - q(0)));
  }
  return worst;
}

TEST(ConvexHull, every_point_lies_behind_every_facet) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  for (const Vec3<double>& radii :
       {Vec3<double>(1, 1, 1), Vec3<double>(1000, 1, 1), Vec3<double>(1, 1, 1e-3),
        Vec3<double>(1, 1e-6, 1e-3), Vec3<double>(1, 1, 1e-10)}) {
    const Points points = on_ellipsoid(300, radii, 1);
    const ConvexHull hull = convex_hull(points);
    EXPECT_EQ(hull.rank(), 3);
    EXPECT_EQ(hull.vertices.size(), points.size()) << radii.transpose();
    // Three roundings a coordinate in the frame, whose thinnest axis magnifies those of the input.
    const double rounding = 16 * epsilon * radii.maxCoeff() / radii.minCoeff();
    EXPECT_LE(furthest_outside(hull, points), rounding) << radii.transpose();
  }
}

TEST(ConvexHull, a_closed_surface_of_triangles_obeys_euler) {
  const ConvexHull hull = convex_hull(on_ellipsoid(500, {1, 2, 3}, 2));
  EXPECT_EQ(hull.facets.size(), 2 * hull.vertices.size() - 4);
}

TEST(ConvexHull, coplanar_neighbours_are_one_facet_and_points_within_are_dropped) {
  Points points = corners_of_a_box();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    Vec3<double> p(uniform(random), 2 * uniform(random), 3 * uniform(random));
    if (i % 2 == 0) p[i % 3] = i % 4 == 0 ? double(i % 3 + 1) : -double(i % 3 + 1);
    points.push_back(p);
  }
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(hull.facets.size(), 6u);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) EXPECT_EQ(hull.facets[f].size(), 4u);
}

TEST(ConvexHull, facets_turn_counter_clockwise_seen_from_outside) {
  for (const double mirror : {1.0, -1.0}) {
    Points points = corners_of_a_box();
    for (auto& p : points) p.x() *= mirror;
    const ConvexHull hull = convex_hull(points);
    for (std::size_t f = 0; f < hull.facets.size(); ++f) {
      const auto p = [&](std::size_t i) { return points[hull.vertices[hull.facets[f][i]]]; };
      EXPECT_GT((p(1) - p(0)).cross(p(2) - p(0)).dot(p(0)), 0);
    }
  }
}

TEST(ConvexHull, flat_sets_keep_their_rank_wherever_they_lie) {
  const Vec3<double> u = Vec3<double>(1, 2, -0.5).normalized();
  const Vec3<double> v = u.unitOrthogonal();
  for (const double away : {0.0, 1.0, 1e5}) {
    const Vec3<double> origin(away, -away, 0.3 * away);
    Points line, square;
    for (int i = 0; i <= 10; ++i) line.push_back(origin + (0.1 * i) * u);
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) square.push_back(origin + (0.1 * i) * u + (0.1 * j) * v);
    EXPECT_EQ(convex_hull(line).rank(), 1);
    EXPECT_EQ(convex_hull(line).vertices, (std::vector<std::uint32_t>{0, 10}));
    const ConvexHull hull = convex_hull(square);
    EXPECT_EQ(hull.rank(), 2);
    ASSERT_EQ(hull.facets.size(), 1u);
    for (const std::uint32_t corner : {0u, 10u, 110u, 120u})
      EXPECT_TRUE(std::ranges::count(hull.vertices, corner)) << away;
    EXPECT_EQ(convex_hull(Points(7, origin)).rank(), 0);
    EXPECT_EQ(convex_hull(Points(7, origin)).vertices.size(), 1u);
  }
}

TEST(ConvexHull, repeated_points_are_kept_once) {
  Points points = corners_of_a_box();
  const Points once = points;
  for (int i = 0; i < 3; ++i) points.insert(points.end(), once.begin(), once.end());
  EXPECT_EQ(convex_hull(points).vertices.size(), 8u);
}

TEST(ConvexHull, nothing_depends_on_the_unit_of_length) {
  const Points points = on_ellipsoid(100, {1, 0.5, 0.1}, 4);
  const auto expected = convex_hull(points).vertices;
  for (const double unit : {1e-30, 1e-3, 1e30}) {
    Points scaled = points;
    for (auto& p : scaled) p *= unit;
    EXPECT_EQ(convex_hull(scaled).vertices, expected) << unit;
  }
  // Scaled by powers of two, nearly to the ends of the range, where squares overflow.
  for (const int exponent : {-900, 900, 1021}) {
    Points scaled = points;
    for (auto& p : scaled)
      for (double& x : p) x = std::ldexp(x, exponent);
    EXPECT_EQ(convex_hull(scaled).vertices, expected) << exponent;
    // The table of directions as well, which large hulls have.
    const PointCloud cloud(scaled), plain(points);
    for (const Vec3<double>& n : on_ellipsoid(100, {1, 1, 1}, 5)) {
      Vec3<double> support = plain.support(n);
      for (double& x : support) x = std::ldexp(x, exponent);
      EXPECT_EQ(cloud.support(n), support) << exponent;
    }
  }
}

/// Found by fuzzing: Qhull fails on them, since its merged facets become too wide. Joggled copies
/// of them lost points that lie up to 1e-11 of the size outside of the others' hull.
TEST(ConvexHull, that_is_all_but_degenerate_reaches_as_far_as_its_points) {
  const Points found = {{4.157870105926285e+21, -2.482915696275264e+28, 1.3687887984099695e+20},
                        {1.4918507370244733e-19, -1.7056587599640507e-32, 3.6075740289679864e+22},
                        {7.307768629384415e+28, -1.4039402161708091e+33, 3.6073988389424817e+22},
                        {5.827747173725584e-10, -1.4013926903124647e+33, 3.6073988389424817e+22},
                        {1.4918522879881218e-19, -1.7249187940918923e-32, 5.523128206128051e+26},
                        {1.1576537995914607e-32, -5.393679888796925e+23, 3.63480109950867e+31},
                        {0.1719977855682373, -1.4532168440162992e+23, -2.153241069115035e+21},
                        {9.169870534975396e-33, -1.1923869406897765e+32, 8.720200346330153e+27},
                        {1.817679811618666e+31, -6.0691867336024696e+32, 1.2837956844157216e-18},
                        {4.3064810123301633e+21, -6852.27978515625, 433931887312896.0},
                        {7.524370357327494e+28, -1.3426106889678935e+23, 4.135931751882883e+32},
                        {2.823095837936003e+23, -1.4543170641863671e+32, 1.1935286694926833e-18},
                        {2.7369928325558226e+20, -8.612962024660327e+21, 1729175168.0},
                        {50672968.0, -8.403306630863063e-41, 1.7095841264762768e-43},
                        {0.0, -2.384185791015625e-07, 9.3664053054889e+19}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 300; ++round) {
    Points points = found;
    // Some of them twice, but for up to as many digits as they have.
    for (int i = 0; i < 8; ++i) {
      Vec3<double> beside = found[random() % found.size()];
      for (double& x : beside)
        x *= 1 + uniform(random) * std::exp2(-46 * std::abs(uniform(random)));
      points.push_back(beside);
    }
    const ConvexHull hull = convex_hull(points);
    double largest = 0;
    for (const Vec3<double>& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    for (int i = 0; i < 6; ++i) {
      const Vec3<double> n = (i % 2 == 0 ? 1.0 : -1.0) * Vec3<double>::Unit(i / 2);
      double all = n.dot(points[0]), kept = n.dot(points[hull.vertices[0]]);
      for (const Vec3<double>& p : points) all = std::max(all, n.dot(p));
      for (const std::uint32_t v : hull.vertices) kept = std::max(kept, n.dot(points[v]));
      EXPECT_LE(all - kept, fuzz::hull_rounding * largest) << round;
    }
  }
}

TEST(ConvexHull, that_is_wider_than_the_largest_number_is_refused) {
  const Points huge = {{-1e300, 1e300, -5e-324}, {1.7e308, -1.7e308, -1e-30},
                       {-1e-45, 5e-324, 1e300},  {-5e-324, -1e-45, -1e-300},
                       {1e300, 1e200, 3e-39},    {1e38, -1e200, 1e154}};
  EXPECT_THROW(convex_hull(huge), std::runtime_error);
  Points half = huge;
  for (auto& p : half) p *= 0.25;
  const ConvexHull hull = convex_hull(half);
  for (const std::uint32_t v : {0u, 1u})
    EXPECT_EQ(std::count(hull.vertices.begin(), hull.vertices.end(), v), 1) << v;
}

TEST(HalfSpaces, those_of_a_box_meet_in_its_corners) {
  std::vector<HalfSpace> box;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      box.push_back({sign * Vec3<double>::Unit(axis), 10 * sign * (axis == 0) + axis + 1.0});
  box.push_back({Vec3<double>(1, 1, 1), 100});  // touches nothing
  const Points vertices = intersection_vertices(box, {10, 0.1, 0.2});
  ASSERT_EQ(vertices.size(), 8u);
  for (const auto& v : vertices) {
    EXPECT_NEAR(std::abs(v.x() - 10), 1, 1e-14);
    EXPECT_NEAR(std::abs(v.y()), 2, 1e-14);
    EXPECT_NEAR(std::abs(v.z()), 3, 1e-14);
  }
}

TEST(HalfSpaces, that_leave_a_direction_open_are_refused) {
  std::vector<HalfSpace> open;
  for (int axis = 0; axis < 3; ++axis) open.push_back({Vec3<double>::Unit(axis), 1});
  EXPECT_THROW(intersection_vertices(open, Vec3<double>::Zero()), std::runtime_error);
  open.push_back({-Vec3<double>::Ones(), -10});
  EXPECT_THROW(intersection_vertices(open, Vec3<double>::Zero()), std::runtime_error);
}

}  // namespace
}  // namespace minkray
