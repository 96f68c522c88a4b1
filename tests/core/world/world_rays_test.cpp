// SPDX-License-Identifier: MIT
// Rays in batches, blocks and streams get the results that they get alone, bit for bit, for any
// division and in any order; and worlds whose instances have moved give the same results as worlds
// built there.
#include <gtest/gtest.h>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

TEST(WorldRays, bundles_are_answered_as_single_rays) {
  Scatter random;
  const World world(scattered_shapes(300, random));
  Compared compared;
  for (const std::size_t count : {1u, 2u, 5u, 16u, 33u, 64u, 100u})
    for (int kind = 0; kind < 3; ++kind)
      for (int i = 0; i < 15; ++i)
        compared.with_single_rays(world, bundle(random, kind, count, world.instances().size()));
  compared.expect_parts(0.3, 0.9);
}

std::vector<WorldRay> mixed_rays(Scatter& random, std::size_t count, std::size_t instances) {
  std::vector<WorldRay> rays;
  for (int kind = 0; rays.size() < count; kind = (kind + 1) % 3)
    for (const WorldRay& ray : bundle(random, kind, 16, instances)) rays.push_back(ray);
  rays.resize(count);
  return rays;
}

/// A world and the rays at it that are cut into parts.
struct Stream {
  const char* name;
  Instances (*instances)(int, Scatter&);
  int count;
  std::size_t rays;
  std::vector<std::size_t> cuts;
};

class WorldStreams : public ::testing::TestWithParam<Stream> {};

TEST_P(WorldStreams, of_any_cut_and_order_are_answered_as_single_rays) {
  const Stream& stream = GetParam();
  Scatter random;
  const World world(stream.instances(stream.count, random));
  auto rays = mixed_rays(random, stream.rays, world.instances().size());
  for (const std::size_t at_once : stream.cuts) {
    Compared compared;
    for (std::size_t begin = 0; begin < rays.size(); begin += at_once)
      compared.with_single_rays(
          world, std::span(rays).subspan(begin, std::min(at_once, rays.size() - begin)));
    compared.expect_parts(0.2, 1);
    std::reverse(rays.begin(), rays.end());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, WorldStreams,
    ::testing::Values(
        Stream{"a_million_rays_at_all_kinds_of_shapes", scattered_instances, 3000, 1000000, {5000}},
        Stream{"any_cut",
               scattered_instances,
               500,
               3000,
               {1, 3, 31, 32, 33, 100, 1024, 1025, 3000, 3000}},
        Stream{"a_shape_for_each_instance", scattered_shapes, 300, 3000, {10, 3000}}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(WorldRays, half_spaces_and_instances_on_the_move) {
  Scatter random;
  Instances shapes = scattered_instances(300, random);
  shapes.add(HalfSpaceBody<double>{Vec3<double>(0, 0, 1), -9});
  std::vector<Affine<double>> poses;
  std::vector<Movement<double>> movements;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    poses.push_back(shapes.is_half_space(i) ? Affine<double>() : random.pose(12));
    Movement<double>& movement = movements.emplace_back();
    movement.shift = random.point(2);
    if (i % 3 == 0) continue;  // goes without turning
    movement.angle = random.within(0, 3);
    movement.axis = unit<double>(random.point(1));
    movement.pivot = random.point(12);
  }
  World world(std::move(shapes));
  world.pose_all([&](std::size_t i) { return poses[i]; },
                 [&](std::size_t i) { return movements[i]; });
  auto rays = mixed_rays(random, 3000, world.instances().size());
  for (WorldRay& ray : rays) ray.time = random.within(0, 1);
  Compared compared;
  compared.with_single_rays(world, rays);
  compared.expect_parts(0.2, 1);
}

TEST(WorldRays, no_rays_and_no_world) {
  Scatter random;
  const World world(scattered_shapes(20, random)), empty;
  QueryCounts counts;
  world.occluded(std::span<const WorldRay>(), {}, counts);
  world.closest_hits({}, {}, counts);
  empty.closest_hits({}, {}, counts);
  for (const std::size_t count : {8u, 40u}) {
    const auto batch = mixed_rays(random, count, 1);
    std::vector<WorldHit> answers(count);
    std::vector<std::uint8_t> met(count, 1);
    empty.closest_hits(batch, answers, counts);
    empty.occluded(std::span<const WorldRay>(batch), met, counts);
    EXPECT_EQ(met, std::vector<std::uint8_t>(count, 0));
    for (const WorldHit& hit : answers) {
      EXPECT_FALSE(hit.found());
      EXPECT_EQ(hit.cast.status, Status::miss);
    }
  }
  EXPECT_EQ(counts.nodes, 0u);
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
      auto batch = bundle(random, i % 2, 8, 1);
      for (WorldRay& ray : batch) ray.skip = no_instance;
      std::vector<WorldHit> answers(batch.size());
      world.closest_hits(batch, answers, counts);
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
TEST(WorldRays, of_other_solvers_are_answered_as_single_rays) {
  Scatter random;
  CastOptions impatient;
  impatient.solver = &solver::gjk_alone;
  impatient.max_iterations = 3;
  for (const int at_once : {16, 500}) {
    const World world(
        at_once < 100 ? scattered_shapes(100, random) : scattered_instances(200, random),
        impatient);
    QueryCounts together, alone;
    for (int begin = 0; begin < 1600; begin += at_once) {
      const auto batch =
          mixed_rays(random, static_cast<std::size_t>(at_once), world.instances().size());
      std::vector<WorldHit> answers(batch.size());
      world.closest_hits(batch, answers, together);
      for (std::size_t k = 0; k < batch.size(); ++k)
        EXPECT_TRUE(same(answers[k], world.closest_hit(batch[k], alone)));
    }
    EXPECT_GT(together.exhausted, 0u);
  }
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
    Compared compared;
    for (const std::size_t count : {16u, 40u, 64u, 100u, 640u})
      for (int round = 0; round < 40; ++round)
        compared.with_single_rays(world, camera_rays(random, count));
    compared.expect_parts(0.02, 1);
  }
}

TEST(WorldRays, rays_of_a_block_meet_what_is_shown_to_their_kind) {
  Scatter random;
  Instances shapes = scattered_instances(500, random);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    shapes.show_to(i, static_cast<RayKinds>(1 + i % 3));
  const World world(std::move(shapes));
  Compared compared;
  for (int round = 0; round < 60; ++round) {
    auto rays = camera_rays(random, 64);
    for (WorldRay& ray : rays) ray.kinds = static_cast<RayKinds>(1 << round % 2);
    if (round % 3 == 0) rays[round].kinds = 3;
    compared.with_single_rays(world, rays);
  }
  EXPECT_GT(compared.hits, 300u);
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
