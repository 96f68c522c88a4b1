// SPDX-License-Identifier: MIT
#include "core/world/half_space.h"

#include <gtest/gtest.h>

#include "core/world/world.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"
#include "tests/support/world_judge.h"

namespace minkray {
namespace {

Ray<double> ray_nearby(testing::Random& random) {
  return {(5 * random.in_cube()), random.direction()};
}

TEST(HalfSpaces, where_a_ray_enters_its_height_is_zero_and_the_interval_holds_that) {
  testing::Random random(1);
  int hits = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const HalfSpaceBody<double> body{random.direction(), double(random.uniform(-2, 2))};
    const Ray<double> ray = ray_nearby(random);
    const CastResult<double> result = cast_ray(body, ray);
    const auto height = [&](long double t) {
      const Vec3<long double> at =
          ray.origin.cast<long double>() + t * ray.direction.cast<long double>();
      return body.normal.cast<long double>().dot(at) - (long double)(body.offset);
    };
    if (result.status == Status::hit) {
      ++hits;
      EXPECT_GE(height(result.offset_lo), 0.0L);
      if (std::isfinite(result.offset_hi)) {
        EXPECT_LE(height(result.offset_hi), 0.0L);
      }
      EXPECT_LE(result.offset_lo, result.t_offset);
      EXPECT_GE(result.offset_hi, result.t_offset);
      EXPECT_EQ(result.normal, body.normal);
    } else if (result.status == Status::inside) {
      ++inside;
      EXPECT_LE(height(0), 1e-5L);
    } else {
      EXPECT_GE(height(0), -1e-5L);
      EXPECT_GE(height(1e3) - height(0), -1e-2L);
    }
  }
  EXPECT_GT(hits, 4000);
  EXPECT_GT(inside, 4000);
}

// A way that is not finite is neither a hit nor a miss, and no world reports a hit.
TEST(HalfSpaces, a_plane_that_numbers_do_not_reach_is_told) {
  const double most = std::numeric_limits<double>::max(),
               least = std::numeric_limits<double>::denorm_min(),
               infinity = std::numeric_limits<double>::infinity();
  const HalfSpaceBody<double> floor{{0.0, 0.0, 1.0}, 0.0}, beyond{{0.0, 0.0, 1.0}, infinity};
  const HalfSpaceBody<double> askew{{0.6, 0.0, 0.8}, -most};
  const auto status = [](const HalfSpaceBody<double>& body, const Vec3<double>& origin,
                         const Vec3<double>& direction, double t_max) {
    return cast_ray(body, Ray<double>{origin, direction, t_max}).status;
  };
  const Vec3<double> down = {0.0, 0.0, -1.0};
  EXPECT_EQ(status(floor, {0.0, 0.0, 1.0}, least * down, infinity), Status::exhausted);
  EXPECT_EQ(status(floor, {0.0, 0.0, 1.0}, least * down, 1.0), Status::miss);
  EXPECT_EQ(status(floor, {0.0, 0.0, most}, down, infinity), Status::hit);
  EXPECT_EQ(status(askew, {most, 0.0, most}, down, infinity), Status::exhausted);
  EXPECT_EQ(status(beyond, {0.0, 0.0, 0.0}, down, infinity), Status::exhausted);

  if constexpr (std::is_same_v<double, double>) {
    Instances instances;
    instances.add(floor);
    const World world(std::move(instances));
    QueryCounts counts;
    EXPECT_FALSE(world.closest_hit({{0, 0, 1}, least * down}, counts).found());
    EXPECT_EQ(counts.exhausted, 1u);
  }
}

/// Some balls and half-spaces; the latter neither first nor last.
World mixed_world(testing::Random& random) {
  Instances instances;
  for (int i = 0; i < 40; ++i) {
    if (i % 10 == 5) {
      instances.add(HalfSpaceBody<double>{random.direction(), double(-4 - i * 0.02)});
      continue;
    }
    Sphere ball;
    ball.radius = 0.4;
    instances.add(Shape(ball), shifted_by((3 * random.in_cube())));
  }
  return World(std::move(instances));
}

TEST(HalfSpacesInWorlds, a_world_answers_as_each_of_its_instances_alone_would) {
  testing::Random random(2);
  const World world = mixed_world(random);
  int of_half_spaces = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray<double> ray = ray_nearby(random);
    const auto skip = i % 3 == 0 ? static_cast<std::uint32_t>(random.below(40)) : no_instance;
    QueryCounts counts;
    const WorldHit hit = world.closest_hit(ray, counts, skip);
    ASSERT_TRUE(testing::same(hit, testing::first_of_all(world, {ray, skip})));
    EXPECT_EQ(world.occluded(ray, counts, skip), hit.found());
    of_half_spaces += hit.found() && world.instances().is_half_space(hit.instance) ? 1 : 0;
  }
  EXPECT_GT(of_half_spaces, 500);
}

TEST(HalfSpacesInWorlds, rays_together_answer_as_rays_alone) {
  testing::Random random(3);
  const World world = mixed_world(random);
  testing::Compared compared;
  for (int i = 0; i < 300; ++i) {
    const auto count = static_cast<std::size_t>(1 + random.below(100));
    const Vec3<double> from = 3 * random.in_cube(), along = random.direction();
    std::vector<WorldRay> rays;
    for (std::size_t k = 0; k < count; ++k)
      rays.push_back({{from, unit<double>(along + 0.1 * random.in_cube())},
                      k % 7 == 0 ? static_cast<std::uint32_t>(random.below(40)) : no_instance});
    compared.with_single_rays(world, rays);
  }
  EXPECT_GT(compared.hits, compared.rays / 4);
}

TEST(HalfSpaces, turning_and_moving_it_turns_and_moves_the_hit) {
  testing::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Affine<double> pose{random.rotation(), random.in_cube()};
    const HalfSpaceBody<double> body{random.direction(), double(random.uniform(-1, 1))};
    const Ray<double> ray = ray_nearby(random);
    const CastResult<double> before = cast_ray(body, ray);
    const CastResult<double> after = cast_ray(
        body.posed(pose), Ray<double>{pose(ray.origin), Vec3<double>(pose.linear * ray.direction)});
    if (before.status != after.status || before.status != Status::hit) continue;
    const double slack = 64.0 * std::numeric_limits<double>::epsilon() * (1.0 + before.t()) /
                         std::abs(before.normal.dot(ray.direction));
    EXPECT_NEAR(before.t(), after.t(), slack);
    EXPECT_LT((pose.linear * before.normal - after.normal).norm(), double(1e-5));
  }
}

TEST(HalfSpaces, they_move_with_their_world_and_while_the_shutter_is_open) {
  Instances instances;
  instances.add(HalfSpaceBody<double>{{0, 0, 1}, 0});
  World world(std::move(instances));
  const Ray<double> down{{0, 0, 5}, {0, 0, -1}};
  QueryCounts counts;
  EXPECT_EQ(world.closest_hit(down, counts).cast.t(), 5);
  world.pose_all([](std::size_t) { return shifted_by(7, 0, 2); },
                 [](std::size_t) {
                   return Movement<double>{{0, 0, 1}};
                 });
  EXPECT_EQ(world.closest_hit(down, counts, no_instance, 0).cast.t(), 3);
  EXPECT_EQ(world.closest_hit(down, counts, no_instance, 1).cast.t(), 2);
}

}  // namespace
}  // namespace minkray
