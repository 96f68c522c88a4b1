// SPDX-License-Identifier: MIT
// Compares rays at their own times with a world that is posed for each time.
#include "renderer/sensor/moving_scene.h"

#include <gtest/gtest.h>

#include <cstring>

#include "renderer/film/render.h"
#include "renderer/sensor/scan.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

/// Balls, boxes and planes that rest, move, turn and tumble.
Scene restless(testing::Random& random, int count) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  for (int i = 0; i < count; ++i) {
    Object& object = scene.objects.emplace_back();
    object.name = "body " + std::to_string(i);
    if (i % 3 == 0)
      object.shape = Box{{0.3, 0.5, 0.1}};
    else
      object.shape = Capsule{0.2, 0.6};
    object.pose.translation = 4 * random.in_cube();
    if (i % 2 == 0) continue;
    // The rest pose may be far from what the keys move: turns then sweep wide.
    object.motion = Motion{{}, object.pose};
    for (int k = 0; k < 4; ++k) {
      PoseKey key{0.3 * k + 0.1 * random.uniform(0, 1), 0.5 * random.in_cube(), {0, 0, 0, 1}};
      const Vec3<double> axis = random.direction();
      const double half = random.uniform(-1.5, 1.5);
      const Vec3<double> s = axis * std::sin(half);
      key.rotate = {s.x(), s.y(), s.z(), std::cos(half)};
      object.motion->keys.push_back(key);
    }
  }
  Object& ground = scene.objects.emplace_back();
  ground.name = "ground";
  ground.half_space = HalfSpaceBody<double>{{0, 0, 1}, -6};
  Object& wall = scene.objects.emplace_back();
  wall.name = "wall that comes nearer";
  wall.half_space = HalfSpaceBody<double>{{1, 0, 0}, -7};
  wall.motion = Motion{{{0, {0, 0, 0}}, {1, {2, 0, 0}}}, {}};
  set_time(scene, 0);
  return scene;
}

TEST(MovingScenes, answers_have_the_bits_of_a_world_posed_at_each_rays_time) {
  testing::Random random(41);
  int hits = 0, movers_hit = 0;
  for (int trial = 0; trial < 10; ++trial) {
    Scene scene = restless(random, 60);
    const MovingScene moving(scene);
    EXPECT_EQ(moving.movers(), 31u);
    const double begin = random.uniform(-0.2, 1.2), end = begin + random.uniform(0, 1);
    SceneWhile between(moving, begin, end);
    World world = make_world(scene);
    for (int i = 0; i < 300; ++i) {
      const double time = random.uniform(begin, end);
      const Ray<double> ray{8 * random.direction(), random.direction()};
      set_time(scene, time);
      follow(world, scene);
      QueryCounts counts;
      const WorldHit expected = world.closest_hit(ray, counts);
      const WorldHit hit = between.closest_hit({ray}, time, counts);
      ASSERT_EQ(hit.instance, expected.instance);
      if (!hit.found()) continue;
      ++hits;
      movers_hit += scene.objects[hit.instance].motion ? 1 : 0;
      const double a = hit.cast.t(), b = expected.cast.t();
      ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0);
      EXPECT_EQ(hit.cast.normal, expected.cast.normal);
      // Behind it, too.
      const WorldHit next = between.closest_hit({ray, hit.instance}, time, counts);
      EXPECT_EQ(next.instance, world.closest_hit(ray, counts, hit.instance).instance);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(movers_hit, 300);
}

TEST(MovingScenes, sweeps_have_the_same_bits_for_any_threads_and_cut) {
  testing::Random random(42);
  const Scene scene = restless(random, 40);
  SensorRays rays;
  for (int i = 0; i < 30000; ++i)
    rays.rays.push_back({{{0, 0, 0}, random.direction()}, random.uniform(0, 1)});
  ScanOptions options;
  options.returns = 3;
  options.range_noise = 0.01;
  options.dropout = 0.05;
  options.path.motion = Motion{{{0, {-3, 0, 0}}, {1, {3, 1, 0}, {0, 0, 0.6, 0.8}}}, {}};
  const Scan all = scan(scene, rays, options);
  SensorRays some = rays;
  some.rays.resize(12345);
  const Scan part = scan(scene, some, options);
  ASSERT_EQ(part.echoes.size(), 3 * 12345u);
  int hits = 0;
  for (std::size_t i = 0; i < part.echoes.size(); ++i) {
    ASSERT_EQ(std::memcmp(&all.echoes[i].t, &part.echoes[i].t, sizeof(double)), 0) << i;
    ASSERT_EQ(all.echoes[i].object, part.echoes[i].object) << i;
    hits += part.echoes[i].object >= 0 ? 1 : 0;
  }
  EXPECT_GT(hits, 10000);
}

TEST(MovingScenes, a_sensor_on_a_path_sees_from_where_it_is) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  Object& wall = scene.objects.emplace_back();
  wall.name = "wall";
  wall.half_space = HalfSpaceBody<double>{{-1, 0, 0}, -10};
  SensorRays rays;
  for (int i = 0; i <= 10; ++i) rays.rays.push_back({{{0, 0, 0}, {1, 0, 0}}, 0.1 * i});
  ScanOptions options;
  options.pose.translation = {0.5, 0, 0};
  options.path.motion = Motion{{{0, {0, 0, 0}}, {1, {4, 0, 0}}}, {}};
  options.mount.pose.translation = {1, 0, 0};
  const Scan result = scan(scene, rays, options);
  for (std::size_t i = 0; i <= 10; ++i)
    EXPECT_NEAR(result.echoes[i].t, 8.5 - 0.4 * static_cast<double>(i), 1e-12);
}

}  // namespace
}  // namespace minkray
