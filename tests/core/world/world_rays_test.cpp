// SPDX-License-Identifier: MIT
// Rays in batches get the results that they get alone, bit for bit; and worlds whose instances
// have moved give the same results as worlds built there.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

TEST(WorldRays, answers_are_those_of_single_rays) {
  Scatter random;
  const World world(scattered_shapes(300, random));
  std::size_t rays = 0, hits = 0, blocked = 0;
  QueryCounts alone, together;
  for (const std::size_t count : {1u, 2u, 5u, 16u, 33u, 64u, 100u})
    for (int kind = 0; kind < 3; ++kind)
      for (int i = 0; i < 15; ++i) {
        const auto asked = bundle(random, kind, count, world.instances().size());
        std::vector<WorldHit> answers(count);
        world.closest_hits(asked, answers, together);
        std::vector<std::uint8_t> met(count);
        world.occluded(std::span<const WorldRay>(asked), met, together);
        for (std::size_t k = 0; k < count; ++k, ++rays) {
          const WorldHit hit = world.closest_hit(asked[k].ray, alone, asked[k].skip);
          EXPECT_TRUE(same(answers[k], hit)) << count << " rays of kind " << kind;
          EXPECT_EQ(met[k] != 0, world.occluded(asked[k].ray, alone, asked[k].skip));
          EXPECT_EQ(met[k] != 0, hit.found());
          hits += hit.found();
          blocked += met[k];
        }
      }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 9 / 10);
  EXPECT_EQ(blocked, hits);
}

TEST(WorldRays, no_rays_and_no_world) {
  Scatter random;
  const World world(scattered_shapes(20, random)), empty;
  QueryCounts counts;
  world.occluded(std::span<const WorldRay>(), {}, counts);
  world.closest_hits({}, {}, counts);
  EXPECT_EQ(counts.nodes, 0u);
  const auto asked = bundle(random, 0, 8, 1);
  std::vector<WorldHit> answers(asked.size());
  empty.closest_hits(asked, answers, counts);
  std::vector<std::uint8_t> met(asked.size(), 1);
  empty.occluded(std::span<const WorldRay>(asked), met, counts);
  EXPECT_EQ(std::count(met.begin(), met.end(), 0), 8);
  for (const WorldHit& hit : answers) {
    EXPECT_FALSE(hit.found());
    EXPECT_EQ(hit.cast.status, Status::miss);
  }
}

TEST(WorldRays, of_instances_at_the_same_t_the_first_is_met) {
  Scatter random;
  for (const bool backwards : {false, true}) {
    Instances pairs;
    std::vector<Affine<double>> poses;
    for (int i = 0; i < 50; ++i) poses.push_back(random.pose(5));
    for (int copy = 0; copy < 3; ++copy) {
      for (const Affine<double>& pose : poses) pairs.add(Shape(Box{{1, 0.5, 0.4}}), pose);
      if (backwards) std::reverse(poses.begin(), poses.end());
    }
    const World world(std::move(pairs));
    QueryCounts counts;
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
      auto asked = bundle(random, i % 2, 8, 1);
      for (WorldRay& ray : asked) ray.skip = no_instance;
      std::vector<WorldHit> answers(asked.size());
      world.closest_hits(asked, answers, counts);
      for (const WorldHit& hit : answers) {
        if (!hit.found()) continue;
        EXPECT_LT(hit.instance, 50u);
        ++hits;
      }
    }
    EXPECT_GT(hits, 200);
  }
}

// Rays that come together find what is exhausted, too.
TEST(WorldRays, other_solvers_are_asked_one_by_one) {
  Scatter random;
  CastOptions impatient;
  impatient.solver = SolverKind::paper;
  impatient.max_iterations = 3;
  const World world(scattered_shapes(100, random), impatient);
  QueryCounts together, alone;
  for (int i = 0; i < 100; ++i) {
    const auto asked = bundle(random, 0, 16, 1);
    std::vector<WorldHit> answers(asked.size());
    world.closest_hits(asked, answers, together);
    for (std::size_t k = 0; k < asked.size(); ++k)
      EXPECT_TRUE(same(answers[k], world.closest_hit(asked[k].ray, alone, asked[k].skip)));
  }
  EXPECT_GT(together.exhausted, 0u);
}

TEST(WorldRays, the_build_of_the_hierarchy_does_not_show) {
  Scatter random, again;
  const World quality(scattered_shapes(300, random)),
      speed(scattered_shapes(300, again), {}, BvhBuild::speed);
  QueryCounts counts;
  for (int i = 0; i < 1000; ++i) {
    const WorldRay ray = bundle(random, 2, 1, 300)[0];
    EXPECT_TRUE(same(quality.closest_hit(ray.ray, counts, ray.skip),
                     speed.closest_hit(ray.ray, counts, ray.skip)));
  }
}

/// Rays from one point through neighbouring pixels, as blocks take them.
std::vector<WorldRay> camera_rays(Scatter& random, std::size_t count) {
  const Vec3<double> from = random.point(20), towards = -from * random.within(0.01, 10);
  std::vector<WorldRay> rays;
  for (std::size_t i = 0; i < count; ++i)
    rays.push_back({{from, towards + 0.1 * towards.norm() * random.point(1)}});
  if (random.within(0, 1) < 0.3)
    for (WorldRay& ray : rays) ray.ray.t_max = random.within(0.2, 2);
  return rays;
}

void expect_single_answers(const World& world, std::span<const WorldRay> rays, int& hits) {
  QueryCounts counts;
  std::vector<WorldHit> answers(rays.size());
  world.closest_hits(rays, answers, counts);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const WorldHit alone = world.closest_hit(rays[i], counts);
    ASSERT_TRUE(same(answers[i], alone)) << i;
    hits += alone.found();
  }
}

TEST(WorldRays, blocks_of_camera_rays_answer_as_single_rays) {
  Scatter random;
  std::vector<World> worlds;
  worlds.emplace_back(scattered_instances(2000, random));  // of all kinds, moved, turned and scaled
  {
    Instances with_planes = scattered_instances(300, random);
    with_planes.add(HalfSpaceBody<double>{Vec3<double>(0, 0, 1), -9});
    with_planes.add(HalfSpaceBody<double>{Vec3<double>(0, 1, 0), -11});
    worlds.emplace_back(std::move(with_planes));
  }
  for (const Shape& shape : {Shape(Sphere{0.7}), Shape(Rounded{0.1, Shape(Box{{0.6, 0.5, 0.3}})}),
                             Shape(Cone{0.5, 0.8})}) {
    Instances one_kind;
    for (int i = 0; i < 500; ++i) one_kind.add(shape, random.pose(8));
    worlds.emplace_back(std::move(one_kind));
  }
  {
    Instances hulls;  // each of its own points
    for (int i = 0; i < 200; ++i) {
      std::vector<Vec3<double>> points;
      for (int k = 0; k < 8 + i % 90; ++k) points.push_back(random.point(0.8));
      hulls.add(Shape(Hull{PointCloud(points)}), random.pose(6));
    }
    worlds.emplace_back(std::move(hulls));
  }
  for (const World& world : worlds) {
    int hits = 0;
    for (const std::size_t count : {16u, 40u, 64u, 100u, 640u})
      for (int round = 0; round < 40; ++round)
        expect_single_answers(world, camera_rays(random, count), hits);
    EXPECT_GT(hits, 40 * 860 / 50);
  }
}

TEST(WorldRays, rays_of_a_block_meet_what_is_shown_to_their_kind) {
  Scatter random;
  Instances shapes = scattered_instances(500, random);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    shapes.show_to(i, static_cast<RayKinds>(1 + i % 3));
  const World world(std::move(shapes));
  int hits = 0;
  for (int round = 0; round < 60; ++round) {
    auto rays = camera_rays(random, 64);
    for (WorldRay& ray : rays) ray.kinds = static_cast<RayKinds>(1 << round % 2);
    if (round % 3 == 0) rays[round].kinds = 3;
    expect_single_answers(world, rays, hits);
  }
  EXPECT_GT(hits, 300);
}

// One world is the tree around the moved instances, the other a tree rebuilt from them.
TEST(WorldRays, moved_instances_answer_as_if_built_where_they_are) {
  Scatter random;
  std::vector<Affine<double>> poses(400);
  const Shape shape = Rounded{0.1, Shape(Box{{0.6, 0.5, 0.3}})};
  const auto pose_of = [&](std::size_t i) { return poses[i]; };
  const auto instances = [&] {
    Instances made;
    made.add_many(made.define(shape), poses.size(), pose_of);
    return made;
  };
  int hits = 0;
  for (const bool alike : {false, true}) {
    for (Affine<double>& pose : poses) pose = random.pose(6);
    if (alike)
      for (Affine<double>& pose : poses) pose.linear = poses[0].linear;
    World world(instances());
    for (int step = 0; step < 3; ++step) {
      for (Affine<double>& pose : poses) {
        const Affine<double> turn = random.pose(0.5);
        pose = {turn.linear * pose.linear, pose.translation + turn.translation};
      }
      poses[7].linear.setIdentity();
      world.pose_all(pose_of);
      const World anew(instances());
      QueryCounts counts;
      for (int i = 0; i < 300; ++i) {
        const WorldRay ray = bundle(random, 2, 1, poses.size())[0];
        const WorldHit hit = anew.closest_hit(ray.ray, counts, ray.skip);
        EXPECT_TRUE(same(world.closest_hit(ray.ray, counts, ray.skip), hit));
        hits += hit.found();
        if (!hit.found()) continue;
        EXPECT_EQ(world.instances().half_extent(hit.instance),
                  anew.instances().half_extent(hit.instance));
      }
    }
  }
  EXPECT_GT(hits, 500);
}

/// Lanes skip shapes that are too thin or too large for them; the entry of their box is compared
/// with hits behind it.
TEST(World, thin_and_large_shapes_are_met_by_rays_of_any_length) {
  for (const double length : {0.01, 1.0, 2.0, 4.0, 100.0}) {
    for (const double scale : {1.0, 0x1p-30, 0x1p30}) {
      Instances instances;
      instances.add(Shape(Box{{scale, scale, 1e-7 * scale}}));
      instances.add(HalfSpaceBody<double>{{0, 0, 1}, -scale});
      const World world(std::move(instances));
      const Ray<double> ray{{0.1 * scale, 0.2 * scale, 3 * scale}, {0, 0, -length}};
      QueryCounts counts;
      const WorldHit alone = world.closest_hit(ray, counts);
      EXPECT_EQ(alone.instance, 0u) << length << " " << scale;
      const std::vector<WorldRay> rays(8, WorldRay{ray});
      std::vector<WorldHit> hits(8);
      world.closest_hits(rays, hits, counts);
      EXPECT_TRUE(same(alone, hits[3])) << length << " " << scale;
    }
  }
}

}  // namespace
}  // namespace minkray
