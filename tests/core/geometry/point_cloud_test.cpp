// SPDX-License-Identifier: MIT
#include "core/geometry/point_cloud.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace minkray {
namespace {

using Points = std::vector<Vec3<double>>;

Vec3<double> random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3<double>(normal(random), normal(random), normal(random)).normalized();
}

Points on_ellipsoid(int count, const Vec3<double>& radii) {
  std::mt19937 random(1);
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(random_direction(random).cwiseProduct(radii));
  return points;
}

Points prism(int sides, double height) {
  Points points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {-height, height})
      points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  return points;
}

Points grid_on_a_box(int n) {
  Points points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k) points.emplace_back(i - n / 2, j - n / 2, k - n / 2);
  return points;
}

Points turned(Points points) {
  Mat3<double> rotation =
      Eigen::AngleAxisd(0.7, Vec3<double>(1, -2, 0.3).normalized()).toRotationMatrix();
  for (auto& p : points) p = rotation * p;
  return points;
}

struct Cloud {
  const char* name;
  Points points;
};

std::vector<Cloud> clouds() {
  Points bumpy = on_ellipsoid(3000, {1, 1, 1});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0.9, 1);
  for (auto& p : bumpy) p *= height(random);
  Points polygon = prism(400, 0);
  Points far = on_ellipsoid(200, {1, 1, 1});
  for (auto& p : far) p += Vec3<double>(1e5, 1e5, 0);
  return {{"ball", on_ellipsoid(500, {1, 1, 1})},
          {"bumpy", bumpy},
          {"needle", turned(on_ellipsoid(300, {1, 1e-3, 1e-3}))},
          {"pancake", turned(on_ellipsoid(300, {1, 1, 1e-3}))},
          {"foil", turned(on_ellipsoid(300, {1, 1, 1e-9}))},
          {"prism", prism(200, 2)},
          {"turned prism", turned(prism(200, 2))},
          {"polygon", polygon},
          {"turned polygon", turned(polygon)},
          {"box", grid_on_a_box(6)},
          {"turned box", turned(grid_on_a_box(6))},
          {"far", far},
          {"few", on_ellipsoid(10, {1, 2, 3})},
          {"segment", {{0, 0, 0}, {1, 2, 3}, {0.5, 1, 1.5}}},
          {"point", {{1, 2, 3}}}};
}

/// Directions that tie or nearly tie: the axes, normals of triples and of pairs of points, and
/// those turned by a few roundings and by a little.
Points hard_directions(const Points& points, std::mt19937& random) {
  Points directions;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) directions.push_back(sign * Vec3<double>::Unit(axis));
  const auto pick = [&] { return points[random() % points.size()]; };
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> a = pick(), b = pick(), c = pick();
    for (const Vec3<double>& n : {Vec3<double>((b - a).cross(c - a)), Vec3<double>(b - a),
                                  Vec3<double>((b - a).cross(random_direction(random)))}) {
      if (!(n.norm() > 0)) continue;
      for (const double turn : {0.0, 1e-15, 1e-8, 1e-3})
        directions.push_back(n.normalized() + turn * random_direction(random));
    }
  }
  return directions;
}

void expect_maximum(const PointCloud& cloud, const Points& all, const Vec3<double>& n,
                    const char* name) {
  double best = -std::numeric_limits<double>::infinity(), size = 0;
  for (const auto& p : all) {
    best = std::max(best, n.dot(p));
    size = std::max(size, p.norm());
  }
  const double found = n.dot(cloud.support(n));
  // A point is rounded by epsilon / 2 of its size, a product of three terms by 3 * epsilon / 2 of
  // it, twice (winner and loser); the hull dropped what lies within 16 epsilon of double.
  const double rounding = 5 * std::numeric_limits<double>::epsilon() * size * n.norm();
  const double dropped = 16 * std::numeric_limits<double>::epsilon() * size * n.norm();
  ASSERT_NEAR(found, best, rounding + dropped) << name << ", n = " << n.transpose();
}

TEST(PointCloud, the_support_maximises_over_all_points_that_were_given) {
  for (const Cloud& cloud : clouds()) {
    const PointCloud hull(cloud.points);
    std::mt19937 random(7);
    Points directions = hard_directions(cloud.points, random);
    for (int i = 0; i < 2000; ++i) directions.push_back(random_direction(random));
    for (const auto& n : directions) {
      expect_maximum(hull, cloud.points, n, cloud.name);
    }
  }
}

TEST(PointCloud, the_length_of_a_direction_does_not_matter) {
  const PointCloud cloud(on_ellipsoid(500, {1, 2, 3}));
  std::mt19937 random(8);
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> n = random_direction(random);
    for (const double length : {0x1p-40, 0x1p20})
      EXPECT_EQ(cloud.support(Vec3<double>(n * length)), cloud.support(n));
  }
}

TEST(PointCloud, any_direction_at_all_gets_a_point_of_the_hull) {
  const PointCloud cloud(on_ellipsoid(500, {1, 2, 3}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3<double>& n :
       {Vec3<double>(0, 0, 0), Vec3<double>(nan, 1, 0), Vec3<double>(nan, nan, nan),
        Vec3<double>(5e-324, 0, 0), Vec3<double>(std::numeric_limits<double>::infinity(), 0, 0)})
    EXPECT_TRUE(std::ranges::count(cloud.points(), cloud.support(n)));
}

TEST(PointCloud, only_extreme_points_are_kept_in_their_order) {
  Points points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}, {0, 1, 0}, {0, 0, 0.5}};
  const PointCloud cloud(points, "some.obj");
  EXPECT_EQ(cloud.points(), (Points{points[0], points[1], points[2], points[4]}));
  EXPECT_EQ(cloud.source(), "some.obj");
}

TEST(PointCloud, a_million_points_take_less_than_a_few_seconds) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Points points;
  for (int i = 0; i < 1000000; ++i)
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  const auto corners = static_cast<std::ptrdiff_t>(points.size());
  for (const auto& corner : turned(prism(4, 3))) points.push_back(corner);
  const PointCloud cloud(points);
  for (auto corner = points.begin() + corners; corner != points.end(); ++corner)
    EXPECT_EQ(cloud.support(Vec3<double>(*corner)), *corner);
  EXPECT_LT(cloud.memory_bytes(), 1000000u);
}

}  // namespace
}  // namespace minkray
