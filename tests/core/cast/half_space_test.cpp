// SPDX-License-Identifier: MIT
// Compares casts at hulls and boxes with half-space clipping in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/oracle/half_spaces.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using Long = long double;

struct Polytope {
  std::string name;
  std::vector<Vec3<double>> points;
};

std::vector<Vec3<double>> on_ellipsoid(int count, const Vec3<double>& radii, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3<double>> points;
  for (int i = 0; i < count; ++i) points.push_back(random.direction().cwiseProduct(radii));
  return points;
}

std::vector<Vec3<double>> prism(int sides, double height) {
  std::vector<Vec3<double>> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 6.283185307179586 * i / sides;
    for (const double z : {-height, height})
      points.push_back({std::cos(angle), std::sin(angle), z});
  }
  return points;
}

std::vector<Polytope> polytopes() {
  return {
      {"tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {"cube",
       {{-1, -1, -1},
        {1, -1, -1},
        {-1, 1, -1},
        {1, 1, -1},
        {-1, -1, 1},
        {1, -1, 1},
        {-1, 1, 1},
        {1, 1, 1}}},
      {"octahedron", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}},
      {"prism of 12 sides", prism(12, 0.5)},
      {"flat prism", prism(7, 0.01)},
      {"tower", prism(5, 40)},
      {"16 on a sphere", on_ellipsoid(16, {1, 1, 1}, 21)},
      {"48 on a sphere", on_ellipsoid(48, {1, 1, 1}, 22)},
      {"24 on an egg, beside the origin",
       [] {
         auto points = on_ellipsoid(24, {1, 0.5, 0.25}, 23);
         for (auto& p : points) p += Vec3<double>(3, -2, 5);
         return points;
       }()},
      {"20 on a needle", on_ellipsoid(20, {1, 0.03, 0.03}, 24)},
  };
}

/// `detour`: the points are rounded to floats first.
void compare(const Polytope& polytope, RayFamily family, int count, bool detour = false) {
  SCOPED_TRACE(polytope.name);
  std::vector<Vec3<double>> points;
  for (const auto& p : polytope.points)
    points.push_back(detour ? Vec3<double>(p.cast<float>().cast<double>()) : p);
  const Shape shape = Hull{PointCloud(points)};
  const PreparedShape prepared(shape);
  const HalfSpaces planes(points);
  const double radius = double(prepared.inner_ball().radius);
  double largest = radius;
  for (const auto& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  // As certificates allow (core/proof/check_certificate.h): planes are known so well.
  const Long allowed = Long(64 * std::numeric_limits<double>::epsilon()) * largest;
  FamilyRays rays(shape, family, 41);
  int hits = 0, misses = 0;
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next();
    const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
    const HalfSpaces::Part grown = planes.clip(o, d, allowed), shrunk = planes.clip(o, d, -allowed);
    const CastResult<double> result = cast_ray(prepared, ray);
    const auto describe = [&] {
      std::ostringstream text;
      text.precision(17);
      text << i << ": " << name_of(result.status) << " at " << result.t() << ", origin "
           << ray.origin.transpose() << ", direction " << ray.direction.transpose();
      return text.str();
    };
    ASSERT_NE(result.status, Status::exhausted) << describe();
    if (grown.empty() || grown.upper < 0) {
      ++misses;
      ASSERT_EQ(result.status, Status::miss) << describe();
    }
    if (shrunk.empty()) continue;
    if (shrunk.lower > 0) {
      ++hits;
      ASSERT_EQ(result.status, Status::hit) << describe();
      // Within the planes moved by what is allowed; at edges, of the plane that was answered.
      const Long t = Long(result.t_base) + Long(result.t_offset);
      const Long slope = std::abs(result.normal.cast<Long>().dot(d));
      const Long error = std::abs(t - planes.clip(o, d).lower) * slope;
      EXPECT_TRUE((t >= grown.lower && t <= shrunk.lower) || error <= allowed)
          << describe() << ", truly at " << double(planes.clip(o, d).lower);
      if (family == RayFamily::random) {
        EXPECT_NEAR(double(result.normal.cast<Long>().dot(shrunk.normal)), 1,
                    1024 * std::numeric_limits<double>::epsilon())
            << describe();
      }
    } else if (shrunk.upper > 0) {
      ASSERT_EQ(result.status, Status::inside) << describe();
    }
  }
  EXPECT_GT(hits + misses, count / 20);
}

TEST(HalfSpaces, of_a_cube_are_six_planes_in_many_copies) {
  const HalfSpaces cube(polytopes()[1].points);
  EXPECT_GE(cube.size(), 6u);
  const auto part = cube.clip({5, 0.25L, 0.5L}, {-1, 0, 0});
  EXPECT_EQ(part.lower, 4);
  EXPECT_EQ(part.upper, 6);
  EXPECT_TRUE(cube.clip({5, 1.5L, 0}, {-1, 0, 0}).empty());
}

class BesideHalfSpaces : public ::testing::TestWithParam<RayFamily> {};

TEST_P(BesideHalfSpaces, at_all_hulls) {
  for (const Polytope& polytope : polytopes()) compare(polytope, GetParam(), 1000);
}

TEST_P(BesideHalfSpaces, with_points_rounded_to_floats) {
  for (const Polytope& polytope : polytopes()) compare(polytope, GetParam(), 1000, true);
}

INSTANTIATE_TEST_SUITE_P(Hulls, BesideHalfSpaces,
                         ::testing::Values(RayFamily::random, RayFamily::grazing,
                                           RayFamily::degenerate, RayFamily::far),
                         [](const auto& tested) {
                           for (const RayFamilyDescription& d : ray_families)
                             if (d.family == tested.param) return std::string(d.name);
                           return std::string();
                         });

}  // namespace
}  // namespace minkray::testing
