// SPDX-License-Identifier: MIT
// Compares the oracle for many lines with the slow one.
#include "tests/oracle/line_entry.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/cast/cast.h"
#include "tests/oracle/portal.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using V = Vec3<Long>;

Shape hull_of(int points) {
  Random random(7);
  std::vector<Vec3<double>> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(random.direction());
  return Hull{PointCloud(cloud)};
}

void expect_as_portal(const Shape& shape, int rays) {
  const LineEntries entries(shape);
  const PortalCast portal(shape);
  const PreparedShape prepared(shape);
  Random random(3);
  int hits = 0, misses = 0;
  for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
    FamilyRays source(shape, family, 5);
    for (int i = 0; i < rays; ++i) {
      const Ray<double> ray = source.next();
      const V o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
      const PortalHit slow = portal(o, d, 1e-15L);
      if (slow.answer == PortalHit::Answer::undecided) continue;
      const Vec3<double> guess = cast_ray(prepared, ray).normal + 1e-4 * random.direction();
      const LineEntry entry = entries(o, d, guess);
      const bool is_hit = slow.answer == PortalHit::Answer::hit;
      ASSERT_EQ(static_cast<int>(entry.answer),
                static_cast<int>(is_hit ? LineEntry::Answer::hit : LineEntry::Answer::miss));
      ++(is_hit ? hits : misses);
      if (!is_hit) continue;
      const Long along_normal = std::abs((entry.t - slow.t_lo) * slow.normal.dot(d));
      ASSERT_LT(static_cast<double>(along_normal), 3e-15 * source.ball().radius);
    }
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_GT(misses, rays / 4);
}

const Shape box = Box{{1, 0.7, 0.5}}, egg = Ellipsoid{{1, 0.5, 0.25}};

TEST(LineEntry, of_hulls) {
  expect_as_portal(hull_of(20), 300);
}

TEST(LineEntry, of_rounded_hulls) {
  expect_as_portal(Rounded{0.1, hull_of(20)}, 300);
  expect_as_portal(Rounded{3, hull_of(20)}, 300);
}

TEST(LineEntry, of_rounded_boxes) {
  expect_as_portal(Rounded{0.2, box}, 300);
}

TEST(LineEntry, of_box_and_ellipsoid) {
  expect_as_portal(MinkowskiSum{{egg, box}}, 300);
  expect_as_portal(MinkowskiSum{{hull_of(12), egg}}, 300);
}

TEST(LineEntry, of_two_ellipsoids) {
  expect_as_portal(MinkowskiSum{{egg, Shape(Ellipsoid{{0.3, 0.5, 1}})}}, 300);
}

TEST(LineEntry, of_shapes_with_closed_forms) {
  expect_as_portal(Cone{1, 1}, 300);
  expect_as_portal(Superellipsoid{{1, 1, 1}, 4}, 300);
}

TEST(LineEntry, of_other_shapes_is_refused) {
  EXPECT_THROW(LineEntries(Shape(HullOf{{box, egg}})), std::invalid_argument);
  EXPECT_THROW(LineEntries(Shape(Rounded{1, egg})), std::invalid_argument);
}

}  // namespace
}  // namespace minkray::testing
