// SPDX-License-Identifier: MIT
#include "core/world/world.h"

#include <gtest/gtest.h>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using testing::Scatter;

Instances scattered_with_disks(int count, Scatter& random) {
  const std::vector<Shape> kinds = {
      Sphere{0.7},
      Rounded{0.1, Shape(Box{{0.6, 0.5, 0.3}})},
      Ellipsoid{{1, 0.5, 0.2}},
      Cylinder{0.3, 0.8},
      Disk{0.8},
      Triangle{{Vec3<double>(0, 0, 0), Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0)}}};
  Instances shapes;
  for (int i = 0; i < count; ++i)
    shapes.add(kinds[static_cast<std::size_t>(i) % kinds.size()], random.pose(6));
  return shapes;
}

Instances only(const Shape& shape) {
  Instances instances;
  instances.add(shape);
  return instances;
}

TEST(World, closest_hit_is_the_nearest_of_all_instances) {
  Scatter random;
  const World world(scattered_with_disks(110, random));
  int hits = 0, rays = 0;
  for (int i = 0; i < 2000; ++i, ++rays) {
    const Vec3<double> origin = random.point(12);
    const Ray<double> ray{origin, random.point(6) - origin};
    QueryCounts counts;
    const WorldHit hit = world.closest_hit(ray, counts);
    ASSERT_TRUE(testing::same(hit, testing::first_of_all(world, {ray})));
    EXPECT_EQ(counts.exhausted, 0u);
    EXPECT_GT(counts.nodes, 0u);
    EXPECT_LT(counts.casts, world.instances().size());
    hits += hit.found();
  }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 7 / 10);
}

TEST(World, occlusion_agrees_with_the_closest_hit) {
  Scatter random;
  const World world(scattered_with_disks(110, random));
  QueryCounts counts;
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> origin = random.point(12);
    Ray<double> ray{origin, random.point(6) - origin};
    const WorldHit hit = world.closest_hit(ray, counts);
    EXPECT_EQ(world.occluded(ray, counts), hit.found());
    if (hit.cast.status != Status::hit) continue;
    // Just before and just behind the hit point.
    const double step = 64 * std::numeric_limits<double>::epsilon();
    ray.t_max = hit.cast.t() * (1 - step) - step;
    EXPECT_FALSE(world.occluded(ray, counts));
    ray.t_max = hit.cast.t() * (1 + step) + step;
    EXPECT_TRUE(world.occluded(ray, counts));
    // The shape that is left itself does not count.
    ray.t_max = hit.cast.t() * (1 + step) + step;
    const WorldHit other = world.closest_hit(ray, counts, hit.instance);
    EXPECT_NE(other.instance, hit.instance);
    EXPECT_EQ(world.occluded(ray, counts, hit.instance), other.found());
  }
}

TEST(World, empty_worlds_and_rays_from_inside) {
  QueryCounts counts;
  const Ray<double> ray{{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(World().closest_hit(ray, counts).found());
  EXPECT_FALSE(World().occluded(ray, counts));
  EXPECT_EQ(World().closest_hit(ray, counts).cast.status, Status::miss);

  const World around(only(Sphere{1}));
  EXPECT_EQ(around.closest_hit(ray, counts).cast.status, Status::inside);
  EXPECT_EQ(around.closest_hit(ray, counts).cast.t(), 0);
  EXPECT_TRUE(around.occluded(ray, counts));
}

// Casts that do not converge must be visible: the reader of a picture trusts its black.
TEST(World, exhausted_casts_are_counted_and_taken_for_neither) {
  CastOptions impatient;
  impatient.solver = &solver::gjk_alone;
  impatient.max_iterations = 1;
  const World world(only(Box{{1, 1, 1}}), impatient);
  QueryCounts counts;
  const WorldHit hit = world.closest_hit({{-3, 0.2, 0.1}, {1, 0, 0}}, counts);
  EXPECT_FALSE(hit.found());
  EXPECT_EQ(counts.casts, 1u);
  EXPECT_EQ(counts.exhausted, 1u);
}

}  // namespace
}  // namespace minkray
